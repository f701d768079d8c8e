#include "diagnosis/internal/Delivery.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "traces.h"

namespace scanloom::delivery_unittest
{
namespace
{
const LidarDescription kLidar = smallLidar();

Delivery deliveryOfTraces(const std::vector<PacketTrace>& traces)
{
  return deliveryOf(packetRuns(traces, kLidar), kLidar);
}

std::vector<PacketTrace> without(std::vector<PacketTrace> traces, std::size_t first, std::size_t count)
{
  const auto from = traces.begin() + static_cast<std::ptrdiff_t>(first);
  traces.erase(from, from + static_cast<std::ptrdiff_t>(count));
  return traces;
}
}  // namespace

TEST(Delivery, ofAHealthyLidarIsCompleteAndAtItsNominalRate)
{
  const Delivery delivery = deliveryOfTraces(tracesOf(kLidar, 50));
  EXPECT_EQ(delivery.packets, 400u);
  EXPECT_EQ(delivery.loss.packets + delivery.order.duplicates + delivery.order.reordered + delivery.restarts, 0u);
  EXPECT_DOUBLE_EQ(delivery.rates.nominal_packets, 80);
  EXPECT_NEAR(*delivery.rates.packets, 80, 1e-6);
  EXPECT_NEAR(*delivery.rates.blocks, 640, 1e-4);
  EXPECT_DOUBLE_EQ(delivery.validShare(), 1);
}

TEST(Delivery, countsWhatWasLostAndTheLongestGap)
{
  auto traces = without(tracesOf(kLidar, 50), 100, 3);
  traces = without(traces, 200, 1);
  const Delivery delivery = deliveryOfTraces(traces);
  EXPECT_EQ(delivery.loss.packets, 4u);
  EXPECT_EQ(delivery.loss.gaps, 2u);
  EXPECT_EQ(delivery.loss.longest, 3u);
  EXPECT_EQ(delivery.loss.longest_time, 24 * kLidar.blockPeriod());
  EXPECT_DOUBLE_EQ(delivery.lossShare(), 4.0 / 400);
}

TEST(Delivery, aCableOutForThreeSecondsIsLossAndNoRestart)
{
  const Delivery delivery = deliveryOfTraces(without(tracesOf(kLidar, 100), 300, 240));
  EXPECT_EQ(delivery.restarts, 0u);
  EXPECT_EQ(delivery.loss.packets, 240u);
  EXPECT_EQ(delivery.loss.longest_time, 3s);
}

TEST(Delivery, aLidarThatStartsAgainLosesNothing)
{
  auto traces = tracesOf(kLidar, 10);
  for (std::int64_t n = 0; n < 80; ++n)
    traces.push_back(nthTrace(kLidar, n, *traces[79].stamp + Duration{n == 0 ? 20s : 20s}, 0));
  const Delivery by_ids = deliveryOfTraces(traces);
  EXPECT_EQ(by_ids.restarts, 1u);
  EXPECT_EQ(by_ids.loss.packets, 0u);
}

TEST(Delivery, anotherInitIdIsARestart)
{
  const Delivery delivery = deliveryOfTraces(
      tracesOf(kLidar, 10, [](std::int64_t n, PacketTrace& trace) { trace.init_id = n < 40 ? 11 : 12; }));
  EXPECT_EQ(delivery.restarts, 1u);
}

TEST(Delivery, tellsReorderFromLossAndSaysHowFarPacketsWereOvertaken)
{
  auto traces = tracesOf(kLidar, 50);
  std::rotate(traces.begin() + 100, traces.begin() + 101, traces.begin() + 103);  // 100 comes after 101 and 102
  const Duration late = 30ms;
  traces[102].received = traces[100].received + late;
  const Delivery delivery = deliveryOfTraces(traces);
  EXPECT_EQ(delivery.loss.packets, 0u);
  EXPECT_EQ(delivery.order.reordered, 1u);
  EXPECT_EQ(delivery.order.displacement, 2);
  EXPECT_EQ(delivery.order.displacement_time, late);
}

TEST(Delivery, countsDuplicatesOnce)
{
  auto traces = tracesOf(kLidar, 50);
  traces.insert(traces.begin() + 11, traces[10]);
  traces.insert(traces.begin() + 101, traces[95]);
  const Delivery delivery = deliveryOfTraces(traces);
  EXPECT_EQ(delivery.order.duplicates, 2u);
  EXPECT_EQ(delivery.order.reordered, 0u);
  EXPECT_EQ(delivery.sent(), 400u);
}

TEST(Delivery, frameIdsThatWrapAreNoLoss)
{
  std::vector<PacketTrace> traces;
  for (std::int64_t n = 0; n < 400; ++n) traces.push_back(nthTrace(kLidar, n, Timestamp{1s}, 65530));
  const Delivery delivery = deliveryOfTraces(traces);
  EXPECT_EQ(delivery.loss.packets, 0u);
  EXPECT_EQ(delivery.restarts, 0u);
}

TEST(Delivery, outsideOfItsAzimuthWindowALidarLosesNothing)
{
  LidarDescription lidar = smallLidar();
  lidar.first_column = 56;
  lidar.last_column = 15;  // packets 7, 0 and 1 of each turn
  std::vector<PacketTrace> traces;
  for (std::int64_t n = 0; n < 400; ++n)
    if (n % 8 == 7 || n % 8 < 2) traces.push_back(nthTrace(lidar, n));
  const Delivery delivery = deliveryOf(packetRuns(traces, lidar), lidar);
  EXPECT_EQ(delivery.loss.packets, 0u);
  EXPECT_DOUBLE_EQ(delivery.rates.nominal_packets, 30);
  EXPECT_DOUBLE_EQ(delivery.rates.nominal_blocks, 240);
}

TEST(Delivery, ofNothingIsNothing)
{
  const Delivery delivery = deliveryOfTraces({});
  EXPECT_EQ(delivery.packets, 0u);
  EXPECT_FALSE(delivery.rates.packets);
  EXPECT_DOUBLE_EQ(delivery.lossShare(), 0);
}

namespace
{
/** As a Velodyne: no ids, stamps of the hour. */
LidarDescription stampedLidar()
{
  LidarDescription lidar = smallLidar();
  lidar.numbering = Numbering::Stamps;
  lidar.frame_id_modulus = 1;
  lidar.fixed_block_period = 1562500ns;
  return lidar;
}

std::vector<PacketTrace> stampedTraces(int turns)
{
  return tracesOf(stampedLidar(), turns, [](std::int64_t, PacketTrace& trace) { trace.frame_id = 0; });
}
}  // namespace

TEST(Delivery, withoutIdsLossIsWhatTheStampsLeaveRoomFor)
{
  const LidarDescription lidar = stampedLidar();
  const Delivery whole = deliveryOf(packetRuns(stampedTraces(50), lidar), lidar);
  EXPECT_EQ(whole.loss.packets + whole.order.duplicates + whole.order.reordered + whole.restarts, 0u);
  EXPECT_DOUBLE_EQ(whole.rates.nominal_packets, 80);

  const auto traces = without(stampedTraces(50), 100, 3);
  const Delivery holed = deliveryOf(packetRuns(traces, lidar), lidar);
  EXPECT_EQ(holed.loss.packets, 3u);
  EXPECT_EQ(holed.loss.longest_time, 24 * lidar.blockPeriod());
}

TEST(Delivery, withoutIdsAClockThatIsSetIsNoLoss)
{
  const LidarDescription lidar = stampedLidar();
  auto traces = stampedTraces(50);
  for (std::size_t i = 200; i < traces.size(); ++i) *traces[i].stamp += 37s;
  EXPECT_EQ(deliveryOf(packetRuns(traces, lidar), lidar).loss.packets, 0u);
}
}  // namespace scanloom::delivery_unittest
