#include "source/EventQueue.h"

#include <gtest/gtest.h>

#include <thread>

namespace scanloom
{
namespace
{
EventQueue::Waiting scanAt(Duration start)
{
  Scan scan;
  scan.start = Timestamp{start};
  return {scan, Timestamp{start}};
}

EventQueue::Waiting imuAt(Duration stamp)
{
  SensorImu imu;
  imu.sample.stamp = Timestamp{stamp};
  return {imu, Timestamp{stamp}};
}
}  // namespace

TEST(EventQueue, dropsTheOldestScanWhenFullAndKeepsImuSamples)
{
  EventQueue queue(EventQueue::Limits{2, 2, 100});
  for (int i = 0; i < 5; ++i)
  {
    queue.push(imuAt(i * 1s));
    queue.push(scanAt(i * 1s));
  }
  queue.end();

  int imu = 0;
  std::vector<Timestamp> scans;
  while (const auto waiting = queue.pop(0s))
    if (const Scan* scan = std::get_if<Scan>(&waiting->event))
      scans.push_back(scan->start);
    else
      EXPECT_EQ(std::get<SensorImu>(waiting->event).sample.stamp, Timestamp{imu++ * 1s});
  EXPECT_EQ(imu, 5);
  EXPECT_EQ(scans, (std::vector<Timestamp>{Timestamp{3s}, Timestamp{4s}}));
  EXPECT_EQ(queue.droppedScans(), 3u);
  EXPECT_EQ(queue.droppedImuSamples(), 0u);
  EXPECT_TRUE(queue.ended());
}

TEST(EventQueue, boundsImuSamplesToo)
{
  EventQueue queue(EventQueue::Limits{2, 2, 3});
  for (int i = 0; i < 10; ++i) queue.push(imuAt(i * 1s));
  EXPECT_EQ(queue.droppedImuSamples(), 7u);
  EXPECT_EQ(std::get<SensorImu>(queue.pop(0s)->event).sample.stamp, Timestamp{7s});
}

TEST(EventQueue, wakesWhoeverWaits)
{
  EventQueue queue(EventQueue::Limits{2, 2, 3});
  std::thread maker([&] { queue.push(scanAt(1s)); });
  EXPECT_TRUE(queue.pop(10s));
  maker.join();
}

TEST(EventQueue, throwsWhatEndedItAfterAllElse)
{
  EventQueue queue(EventQueue::Limits{2, 2, 3});
  queue.push(scanAt(1s));
  queue.end(std::make_exception_ptr(std::runtime_error("clocks")));
  EXPECT_TRUE(queue.pop(0s));
  EXPECT_FALSE(queue.ended());
  EXPECT_THROW(queue.pop(0s), std::runtime_error);
  EXPECT_TRUE(queue.ended());
}
}  // namespace scanloom
