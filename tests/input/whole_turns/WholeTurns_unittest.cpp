#include "input/whole_turns/WholeTurns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/FakeLidar.h"
#include "support/pushPacket.h"

namespace scanloom::whole_turns_unittest
{
namespace
{
using Packet = std::vector<std::uint8_t>;

struct Arrival
{
  LidarIndex lidar = 0;
  Packet packet;
  Timestamp received;
};

/** Lidars that turn at 10 Hz; each begins its first turn `phase` after 0. */
std::vector<Arrival> turning(const std::vector<Duration>& phases, int turns, const FakeLidarOptions& options = {})
{
  const FakeLidar lidar(options);
  std::vector<Arrival> arrivals;
  for (LidarIndex i = 0; i < phases.size(); ++i)
    for (Packet& packet : lidar.drive(Timestamp{phases[i]}, turns * 100ms))
    {
      const Timestamp last = fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
      arrivals.push_back({i, std::move(packet), last + 100us});
    }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.received < b.received; });
  return arrivals;
}

WholeTurns fakeLidars(std::size_t lidars, TurnGrouping grouping = TurnGrouping::Nearest,
                      const FakeLidarOptions& options = {})
{
  return WholeTurns(std::vector<BatchedLidar>(lidars, {"lidar", std::make_shared<FakeLidar>(options)}), grouping);
}

struct Released
{
  Scan scan;
  Timestamp at;
};

std::vector<Released> feed(WholeTurns& batcher, const std::vector<Arrival>& arrivals)
{
  std::vector<Released> released;
  for (const Arrival& arrival : arrivals)
    for (Scan& scan : push(batcher, arrival.lidar, arrival.packet, arrival.received))
      released.push_back({std::move(scan), arrival.received});
  for (Scan& scan : batcher.finish()) released.push_back({std::move(scan), Timestamp::max()});
  return released;
}

/** Of the sensor's columns in the scan. */
Timestamp firstStampOf(const Scan& scan, std::uint8_t sensor)
{
  const auto column = std::find_if(scan.columns.begin(), scan.columns.end(),
                                   [sensor](const Column& c) { return c.sensor_id == sensor; });
  return column == scan.columns.end() ? Timestamp::max() : column->stamp;
}

void expectAccountsAreClosed(const WholeTurns& batcher)
{
  for (LidarIndex i = 0; i < batcher.lidars().size(); ++i)
  {
    const LidarCounters& c = batcher.counters(i);
    EXPECT_EQ(c.received, c.emitted + c.late + c.duplicate + c.invalid + c.implausible + c.dropped);
  }
}

constexpr int kPacketsPerTurn = 8;

/** Packets without frame ids whose stamps count modulo one second. */
class StampedLidar : public FakeLidar
{
 public:
  explicit StampedLidar(const FakeLidarOptions& options = {})
    : FakeLidar(options), description_(FakeLidar::description())
  {
    description_.numbering = Numbering::Stamps;
    description_.stamp_modulus = 1s;
  }
  const LidarDescription& description() const override { return description_; }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override
  {
    FakeLidar::readBlocks(packet, blocks);
    for (MeasurementBlock& block : blocks)
    {
      block.stamp = Timestamp{block.stamp.time_since_epoch() % 1s};
      block.frame_id = 0;
    }
  }

 private:
  LidarDescription description_;
};

WholeTurns stampedLidar(const FakeLidarOptions& options = {})
{
  return WholeTurns({{"lidar", std::make_shared<StampedLidar>(options)}});
}
}  // namespace

TEST(WholeTurns, aTurnOfOneLidarIsOutWithItsLastPacket)
{
  WholeTurns batcher = fakeLidars(1);
  const auto arrivals = turning({0ms}, 3);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 3u);
  EXPECT_EQ(released[1].at, arrivals[2 * kPacketsPerTurn - 1].received);
  EXPECT_EQ(released[1].scan.start, Timestamp{100ms});
  EXPECT_EQ(released[1].scan.period, Duration{100ms});
  EXPECT_EQ(released[1].scan.columns.size(), 64u);
  EXPECT_TRUE(released[1].scan.complete());
}

TEST(WholeTurns, theScanSpansOneAndAHalfTurnsInTheWorstPhase)
{
  WholeTurns batcher = fakeLidars(2);
  const auto released = feed(batcher, turning({0ms, 50ms}, 4));

  EXPECT_EQ(released[1].scan.period, Duration{150ms});  // the paper, section 1.1
}

TEST(WholeTurns, theNearestTurnMayBeTheOneBefore)
{
  WholeTurns batcher = fakeLidars(2);
  const auto released = feed(batcher, turning({0ms, 70ms}, 4));

  EXPECT_EQ(firstStampOf(released[1].scan, 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(released[1].scan, 1), Timestamp{70ms});
  EXPECT_EQ(released[1].at, Timestamp{200ms} - FakeLidar().description().blockPeriod() + 100us);  // nobody to wait for
}

TEST(WholeTurns, theNearestTurnIsWaitedFor)
{
  WholeTurns batcher = fakeLidars(2);
  const auto released = feed(batcher, turning({0ms, 30ms}, 4));

  EXPECT_EQ(firstStampOf(released[1].scan, 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(released[1].scan, 1), Timestamp{130ms});
  EXPECT_EQ(released[1].at, Timestamp{230ms} - FakeLidar().description().blockPeriod() + 100us);
}

TEST(WholeTurns, oneOfEachMeetsAsTheLidarsWereHeardFirst)
{
  WholeTurns batcher = fakeLidars(2, TurnGrouping::OneOfEach);
  const auto released = feed(batcher, turning({0ms, 70ms}, 4));

  EXPECT_EQ(firstStampOf(released[1].scan, 0), Timestamp{100ms});
  EXPECT_EQ(firstStampOf(released[1].scan, 1), Timestamp{170ms});
  EXPECT_EQ(released[1].scan.period, Duration{170ms});
}

TEST(WholeTurns, everyPointBearsItsOwnTimeAndEachLidarItsOwnOrder)
{
  WholeTurns batcher = fakeLidars(2);
  const auto released = feed(batcher, turning({0ms, 30ms}, 4));

  const Scan& scan = released[1].scan;
  EXPECT_EQ(scan.columns_of, (std::vector<std::uint32_t>{64, 64}));
  EXPECT_EQ(scan.columns[64].sensor_id, 1);
  EXPECT_LT(scan.columns[64].stamp, scan.columns[63].stamp);  // back in time, as approach A does
  std::uint32_t next = 0;
  for (const Column& column : scan.columns)
  {
    EXPECT_EQ(column.first_point, next);
    next += column.count;
    for (std::size_t p = column.first_point; p < next; ++p)
    {
      EXPECT_EQ(scan.start + Duration{scan.points.t[p]}, column.stamp);
      EXPECT_EQ(scan.points.sensor_id[p], column.sensor_id);
      EXPECT_FLOAT_EQ(scan.points.x[p], static_cast<float>(1e3 * seconds(column.stamp.time_since_epoch())));
    }
  }
  EXPECT_EQ(next, scan.points.size());
}

TEST(WholeTurns, aLostPacketIsKnownWhenTheNextTurnBegins)
{
  WholeTurns batcher = fakeLidars(1);
  auto arrivals = turning({0ms}, 3);
  const Timestamp next_turn = arrivals[2 * kPacketsPerTurn].received;
  arrivals.erase(arrivals.begin() + kPacketsPerTurn + 3);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 3u);
  EXPECT_EQ(released[1].at, next_turn);
  EXPECT_FALSE(released[1].scan.complete());
  EXPECT_EQ(released[1].scan.columns.size(), 56u);
  EXPECT_EQ(batcher.counters(0).lost, 8u);
}

TEST(WholeTurns, wholeTurnsThatAreMissingAreCountedToo)
{
  WholeTurns batcher = fakeLidars(1);
  auto arrivals = turning({0ms}, 5);
  arrivals.erase(arrivals.begin() + 2 * kPacketsPerTurn - 1, arrivals.begin() + 4 * kPacketsPerTurn + 2);
  feed(batcher, arrivals);

  EXPECT_EQ(batcher.counters(0).lost, 8u * (1 + 2 * kPacketsPerTurn + 2));
  EXPECT_EQ(batcher.counters(0).sent(), 5u * 64);
}

TEST(WholeTurns, whatComesTwiceOrForATurnThatIsOutIsLeftOut)
{
  WholeTurns batcher = fakeLidars(1);
  auto arrivals = turning({0ms}, 4);
  arrivals.insert(arrivals.begin() + kPacketsPerTurn, arrivals[kPacketsPerTurn - 1]);          // twice, turn is out
  arrivals.insert(arrivals.begin() + 2 * kPacketsPerTurn, arrivals[2 * kPacketsPerTurn - 1]);  // twice, amid the turn
  std::rotate(arrivals.begin() + 2 * kPacketsPerTurn + 5, arrivals.begin() + 2 * kPacketsPerTurn + 6,
              arrivals.begin() + 3 * kPacketsPerTurn + 6);  // into the next turn
  feed(batcher, arrivals);

  EXPECT_EQ(batcher.counters(0).duplicate, 16u);
  EXPECT_EQ(batcher.counters(0).late, 8u);
  EXPECT_EQ(batcher.counters(0).lost, 8u);
  expectAccountsAreClosed(batcher);
}

TEST(WholeTurns, reorderWithinATurnLosesNothing)
{
  WholeTurns batcher = fakeLidars(1);
  auto arrivals = turning({0ms}, 3);
  std::swap(arrivals[kPacketsPerTurn], arrivals[2 * kPacketsPerTurn - 2]);
  const auto released = feed(batcher, arrivals);

  EXPECT_EQ(released[1].scan.columns.size(), 64u);
  EXPECT_EQ(released[1].scan.start, Timestamp{100ms});
  EXPECT_TRUE(released[1].scan.complete());
}

TEST(WholeTurns, aTurnWithinAnAzimuthWindowIsWholeWithTheLastPacketOfTheWindow)
{
  FakeLidarOptions window;
  window.first_column = 20;
  window.last_column = 35;
  WholeTurns batcher = fakeLidars(1, TurnGrouping::Nearest, window);
  const auto arrivals = turning({0ms}, 3, window);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 3u);
  EXPECT_EQ(released[0].at, arrivals[2].received);
  EXPECT_EQ(released[0].scan.columns.size(), 16u);
  EXPECT_TRUE(released[0].scan.complete());
  EXPECT_EQ(batcher.counters(0).lost, 0u);
}

TEST(WholeTurns, aSilentLidarLeavesIncompleteScans)
{
  for (const TurnGrouping grouping : {TurnGrouping::Nearest, TurnGrouping::OneOfEach})
  {
    WholeTurns batcher = fakeLidars(2, grouping);
    auto arrivals = turning({0ms, 30ms}, 10);
    arrivals.erase(std::remove_if(arrivals.begin(), arrivals.end(),
                                  [](const Arrival& a) { return a.lidar == 1 && a.received > Timestamp{350ms}; }),
                   arrivals.end());
    const auto released = feed(batcher, arrivals);

    EXPECT_EQ(released.size(), 10u);
    const Scan& alone = released[6].scan;
    EXPECT_FALSE(alone.complete());
    EXPECT_EQ(alone.columns_of, (std::vector<std::uint32_t>{64, 0}));
  }
}

TEST(WholeTurns, ofALidarTwiceAsFastEverySecondTurnIsDropped)
{
  FakeLidarOptions fast;
  fast.frame_rate = 20;
  WholeTurns batcher({{"slow", std::make_shared<FakeLidar>()}, {"fast", std::make_shared<FakeLidar>(fast)}});
  auto arrivals = turning({0ms}, 10);
  for (Packet& packet : FakeLidar(fast).drive(Timestamp{10ms}, 1s))
  {
    const Timestamp last = fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
    arrivals.push_back({1, std::move(packet), last + 100us});
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.received < b.received; });
  feed(batcher, arrivals);

  EXPECT_EQ(batcher.counters(0).dropped, 0u);
  EXPECT_EQ(batcher.counters(1).emitted, 10u * 64);
  EXPECT_EQ(batcher.counters(1).dropped, 10u * 64);
}

TEST(WholeTurns, withoutFrameIdsATurnIsOutWhenTheAzimuthComesRound)
{
  WholeTurns batcher = stampedLidar();
  const auto arrivals = turning({950ms}, 4);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 4u);
  EXPECT_EQ(released[1].at, arrivals[2 * kPacketsPerTurn].received);
  EXPECT_EQ(released[1].scan.start, Timestamp{1050ms});
  EXPECT_EQ(released[1].scan.columns.size(), 64u);
  EXPECT_FALSE(released[0].scan.complete());  // it may have begun before we listened
  EXPECT_TRUE(released[1].scan.complete());
  EXPECT_FALSE(released[3].scan.complete());  // cut
  EXPECT_EQ(batcher.counters(0).lost, 0u);
}

TEST(WholeTurns, withoutFrameIdsAGapInTheStampsIsLoss)
{
  WholeTurns batcher = stampedLidar();
  auto arrivals = turning({0ms}, 4);
  arrivals.erase(arrivals.begin() + kPacketsPerTurn + 3);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 4u);
  EXPECT_FALSE(released[1].scan.complete());
  EXPECT_TRUE(released[2].scan.complete());
  EXPECT_EQ(batcher.counters(0).lost, 8u);
}

TEST(WholeTurns, withoutFrameIdsAnAzimuthWindowIsNoLoss)
{
  FakeLidarOptions window;
  window.first_column = 20;
  window.last_column = 35;
  WholeTurns batcher = stampedLidar(window);
  const auto released = feed(batcher, turning({0ms}, 4, window));

  ASSERT_EQ(released.size(), 4u);
  EXPECT_EQ(released[2].scan.columns.size(), 16u);
  EXPECT_EQ(batcher.counters(0).lost, 0u);
}

TEST(WholeTurns, withoutFrameIdsWhatIsNotLaterThanTheNewestIsLate)
{
  WholeTurns batcher = stampedLidar();
  auto arrivals = turning({0ms}, 4);
  arrivals.insert(arrivals.begin() + 12, arrivals[11]);
  std::swap(arrivals[20], arrivals[21]);
  feed(batcher, arrivals);

  EXPECT_EQ(batcher.counters(0).late, 16u);
  EXPECT_EQ(batcher.counters(0).lost, 8u);
  expectAccountsAreClosed(batcher);
}

TEST(WholeTurns, withoutFrameIdsAJumpOfTheStampsIsARestart)
{
  WholeTurns batcher = stampedLidar();
  auto arrivals = turning({450ms}, 2);
  for (Arrival& later : turning({2100ms}, 2))  // five turns from where they should be, modulo a second
    arrivals.push_back(later);
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 4u);
  EXPECT_EQ(released[2].scan.start, Timestamp{2100ms});
  EXPECT_EQ(batcher.counters(0).restarts, 1u);
  EXPECT_EQ(batcher.counters(0).late, 0u);
}

TEST(WholeTurns, aRotorThatStandsStillMakesNoEndlessTurn)
{
  WholeTurns batcher = stampedLidar();
  std::size_t longest = 0;
  for (Arrival& arrival : turning({0ms}, 30))
  {
    for (std::size_t at = FakeLidar::kHeaderSize + 12; at < arrival.packet.size(); at += FakeLidar::kBlockSize)
      store<std::uint16_t>(arrival.packet, at, 7);
    for (const Scan& scan : push(batcher, 0, arrival.packet, arrival.received))
      longest = std::max(longest, scan.columns.size());
  }
  EXPECT_EQ(longest, 2u * 64 + 1);
}

TEST(WholeTurns, aLidarThatStartsAgainBeginsAnotherTurn)
{
  WholeTurns batcher = fakeLidars(1);
  auto arrivals = turning({0ms}, 2);
  arrivals.resize(kPacketsPerTurn + 4);
  for (Packet& packet : FakeLidar().drive(Timestamp{700ms}, 200ms, 30000))
    arrivals.push_back({0, std::move(packet), Timestamp{}});
  const auto released = feed(batcher, arrivals);

  ASSERT_EQ(released.size(), 4u);
  EXPECT_FALSE(released[1].scan.complete());
  EXPECT_EQ(released[2].scan.start, Timestamp{700ms});
  EXPECT_EQ(batcher.counters(0).restarts, 1u);
  EXPECT_EQ(batcher.counters(0).lost, 0u);
}

TEST(WholeTurns, accountsAreClosedWhateverTheNetworkDoes)
{
  for (const TurnGrouping grouping : {TurnGrouping::Nearest, TurnGrouping::OneOfEach})
    for (std::uint32_t seed = 0; seed < 50; ++seed)
    {
      std::mt19937 random(seed);
      const auto upTo = [&random](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
      std::vector<Arrival> arrivals;
      for (const Arrival& arrival : turning({0ms, upTo(99) * 1ms, upTo(99) * 1ms}, 8))
        for (int copies = upTo(9) == 0 ? upTo(2) : 1; copies > 0; --copies) arrivals.push_back(arrival);
      for (std::size_t i = 1; i < arrivals.size(); ++i)
        if (upTo(4) == 0) std::swap(arrivals[i], arrivals[i - std::min<std::size_t>(i, std::size_t(upTo(12)))]);
      WholeTurns batcher = fakeLidars(3, grouping);
      for (const Arrival& arrival : arrivals) push(batcher, arrival.lidar, arrival.packet, arrival.received);
      batcher.finish();
      expectAccountsAreClosed(batcher);
    }
}

TEST(WholeTurns, noScanBeginsBeforeTheHorizon)
{
  for (const TurnGrouping grouping : {TurnGrouping::Nearest, TurnGrouping::OneOfEach})
    for (Duration phase = 0ms; phase < 100ms; phase += 7ms)
    {
      WholeTurns batcher = fakeLidars(2, grouping);
      std::optional<Timestamp> horizon;
      for (const Arrival& arrival : turning({phase, 0ms}, 6))
      {
        for (const Scan& scan : push(batcher, arrival.lidar, arrival.packet, arrival.received))
          EXPECT_GE(scan.start, *horizon);
        EXPECT_GE(batcher.horizon(), horizon);
        if (arrival.received > Timestamp{phase + 13ms}) horizon = batcher.horizon();  // both have been heard
      }
      EXPECT_GT(horizon, Timestamp{400ms});
    }
}

TEST(WholeTurns, needsALidar) { EXPECT_THROW(WholeTurns(std::vector<BatchedLidar>{}), std::invalid_argument); }
}  // namespace scanloom::whole_turns_unittest
