/** Recorded Robosense packets through the batcher. */
#include <gtest/gtest.h>

#include "input/batching/TimeBatcher.h"
#include "input/lidar/LidarModels.h"
#include "support/Rosbag.h"
#include "support/TestData.h"
#include "support/pushPacket.h"

namespace scanloom::robosense_replay_unittest
{
/** One of the packets is about the device; the stamps of packets wander by 13 us. */
TEST(RobosenseReplay, losesNothing)
{
  SCANLOOM_NEEDS_DATA(bag,
                      "other-lidars/tier4+nebula/nebula_tests/data/robosense/helios16P/rosbag2_2023_08_03-11_02_46/"
                      "rosbag2_2023_08_03-11_02_46_0.db3");
  const std::shared_ptr<const PacketDecoder> decoder = makeDecoder("Helios-5515", Rigid::identity());
  TimeBatcher batcher({{"roof", decoder, Duration{0}}}, {});
  std::vector<Column> columns;
  const auto take = [&](const std::vector<Scan>& scans)
  {
    for (const Scan& scan : scans) columns.insert(columns.end(), scan.columns.begin(), scan.columns.end());
  };
  for (const StampedPacket& packet : robosensePacketsOfBag(bag)) take(push(batcher, 0, packet.bytes, packet.received));
  take(batcher.finish());

  const LidarCounters& c = batcher.counters(0);
  EXPECT_EQ(c.received, 750U * 12);
  EXPECT_EQ(c.received, c.emitted + c.before_start);
  EXPECT_EQ(c.lost + c.doubtful_packets + c.malformed_packets + c.restarts + c.clock_steps, 0U);
  EXPECT_TRUE(batcher.takeNotices().empty());
  for (std::size_t i = 1; i < columns.size(); ++i)
    EXPECT_NEAR(seconds(columns[i].stamp - columns[i - 1].stamp), 55.56e-6, 15e-6);
}
}  // namespace scanloom::robosense_replay_unittest
