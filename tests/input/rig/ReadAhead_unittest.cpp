#include "input/rig/ReadAhead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace scanloom::read_ahead_unittest
{
namespace
{
/** Every fourth event is a scan; their stamps are their numbers. */
class NumberedInput : public SensorInput
{
 public:
  explicit NumberedInput(int events, bool damaged = false) : events_(events), damaged_(damaged) {}

  std::optional<SensorEvent> next(Duration) override
  {
    if (read == events_ && damaged_) throw std::runtime_error("damaged");
    ended_ = read == events_;
    if (ended_) return std::nullopt;
    const Timestamp stamp = fromNanoseconds(read++);
    if (stamp.time_since_epoch().count() % 4 != 3) return SensorImu{SensorImu::kBody, ImuSample{stamp}};
    Scan scan;
    scan.start = stamp;
    return scan;
  }

  bool ended() const override { return ended_; }
  void stop() override {}
  SensorSetup setup() const override { return {}; }
  double progress() const override { return 1.0 * read / events_; }
  RigAccount account() const override
  {
    RigAccount account;
    account.input["events"] = static_cast<std::uint64_t>(read);
    return account;
  }

  std::atomic<int> read{0};

 private:
  int events_;
  bool damaged_, ended_ = false;
};

std::int64_t stampOf(const SensorEvent& event)
{
  if (const auto* scan = std::get_if<Scan>(&event)) return nanoseconds(scan->start);
  return nanoseconds(std::get<SensorImu>(event).sample.stamp);
}

TEST(ReadAhead, givesTheSameEventsInTheSameOrder)
{
  ReadAhead input(std::make_unique<NumberedInput>(10'000));
  std::int64_t expected = 0;
  while (const auto event = input.next(1s)) ASSERT_EQ(stampOf(*event), expected++);

  EXPECT_TRUE(input.ended());
  EXPECT_EQ(expected, 10'000);
  EXPECT_EQ(input.account().input.at("events"), 10'000U);
  EXPECT_EQ(input.stages().at("reading").runs, 10'001U);
}

TEST(ReadAhead, saysHowFarTheCallerIsAndNotTheReader)
{
  ReadAhead input(std::make_unique<NumberedInput>(8), 2);
  for (int i = 1; i <= 8; ++i)
  {
    input.next(1s);
    EXPECT_DOUBLE_EQ(input.progress(), i / 8.0);
  }
}

TEST(ReadAhead, readsNothingBeforeItIsAskedAndThenTwoScansAtMost)
{
  auto owned = std::make_unique<NumberedInput>(1000);
  const std::atomic<int>& read = owned->read;
  ReadAhead input(std::move(owned), 2);
  std::this_thread::sleep_for(10ms);
  EXPECT_EQ(read, 0);

  input.next(1s);
  const auto patience = std::chrono::steady_clock::now() + 10s;
  while (read < 8 && std::chrono::steady_clock::now() < patience) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(10ms);

  EXPECT_EQ(read, 8) << "scans are 3 and 7";
}

TEST(ReadAhead, throwsWhatTheInputThrowsAfterTheEventsBefore)
{
  ReadAhead input(std::make_unique<NumberedInput>(6, true));
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(input.next(1s));

  EXPECT_THROW(input.next(1s), std::runtime_error);
  EXPECT_FALSE(input.next(1s));
  EXPECT_TRUE(input.ended());
}

TEST(ReadAhead, endsAmidTheInput)
{
  ReadAhead input(std::make_unique<NumberedInput>(1000));
  EXPECT_TRUE(input.next(1s));
}
}  // namespace
}  // namespace scanloom::read_ahead_unittest
