#include "batching/Batcher.h"

#include <gtest/gtest.h>

#include "batching/TimeBatcher.h"
#include "batching/WholeTurns.h"
#include "support/FakeLidar.h"

using namespace scanloom;

namespace
{
std::unique_ptr<Batcher> named(const std::string& name)
{
  BatcherOptions options;
  options.batching = name;
  return makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options);
}

template <typename T>
bool is(const std::unique_ptr<Batcher>& batcher)
{
  return dynamic_cast<const T*>(batcher.get()) != nullptr;
}
}  // namespace

TEST(Batcher, isTheOneThatTheOptionNames)
{
  EXPECT_TRUE(is<TimeBatcher>(named(BatcherOptions{}.batching)));
  EXPECT_TRUE(is<TimeBatcher>(named("time")));
  EXPECT_TRUE(is<WholeTurns>(named("nearest_turns")));
  EXPECT_TRUE(is<WholeTurns>(named("one_turn_of_each")));
  EXPECT_THROW(named("turns"), std::invalid_argument);
}

TEST(Batcher, wholeTurnsHaveNoSlices)
{
  BatcherOptions options;
  options.slices = 4;
  EXPECT_NO_THROW(makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options));
  options.batching = "nearest_turns";
  EXPECT_THROW(makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options), std::invalid_argument);
}

TEST(Batcher, givesTheSameScansFromRecycledMemory)
{
  for (const std::string name : {"time", "nearest_turns"})
  {
    const auto fresh = named(name), recycled = named(name);
    const FakeLidar lidar;
    for (const auto& packet : lidar.drive(Timestamp{}, 1s))
    {
      const Timestamp received = fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
      const auto expected = fresh->push(0, packet, received);
      auto scans = recycled->push(0, packet, received);
      ASSERT_EQ(scans.size(), expected.size());
      for (std::size_t i = 0; i < scans.size(); ++i)
      {
        EXPECT_EQ(scans[i].start, expected[i].start);
        EXPECT_EQ(scans[i].columns.size(), expected[i].columns.size());
        EXPECT_TRUE(std::equal(scans[i].points.x.begin(), scans[i].points.x.end(), expected[i].points.x.begin()));
        EXPECT_EQ(scans[i].points.size(), expected[i].points.size());
        EXPECT_EQ(scans[i].missing, expected[i].missing);
        recycled->recycle(std::move(scans[i]));
      }
    }
    EXPECT_GT(recycled->counters(0).emitted, 500u);
  }
}
