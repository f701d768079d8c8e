#include "input/batching/ImuOrder.h"

#include <gtest/gtest.h>

namespace scanloom::imu_order_unittest
{
namespace
{
SensorImu imu(int sensor, Duration stamp)
{
  SensorImu s;
  s.sensor = sensor;
  s.sample.stamp = Timestamp{stamp};
  return s;
}
}  // namespace

TEST(ImuOrder, releasesByStampThenSensorUpToTheHorizon)
{
  ImuOrder order;
  for (const SensorImu& s : {imu(1, 20ms), imu(0, 10ms), imu(0, 20ms), imu(SensorImu::kBody, 20ms), imu(0, 30ms)})
    order.add(s);
  const auto released = order.release(Timestamp{30ms});
  ASSERT_EQ(released.size(), 4u);
  EXPECT_EQ(released[0].sample.stamp, Timestamp{10ms});
  EXPECT_EQ(released[1].sensor, SensorImu::kBody);
  EXPECT_EQ(released[2].sensor, 0);
  EXPECT_EQ(released[3].sensor, 1);
}

TEST(ImuOrder, countsWhatComesAfterItsPlaceWasGivenOut)
{
  ImuOrder order;
  order.release(Timestamp{30ms});
  order.add(imu(0, 29ms));
  EXPECT_EQ(order.late(), 1u);
  EXPECT_TRUE(order.release(Timestamp{1s}).empty());
}

TEST(ImuOrder, movesWhatWaitsOfASensorWhoseClockIsAnother)
{
  ImuOrder order;
  for (const SensorImu& s : {imu(0, 10ms), imu(1, 20ms), imu(0, 30ms)}) order.add(s);
  order.shift(0, 15ms);
  const auto released = order.release(Timestamp::max());
  ASSERT_EQ(released.size(), 3u);
  EXPECT_EQ(released[0].sensor, 1);
  EXPECT_EQ(released[1].sample.stamp, Timestamp{25ms});
  EXPECT_EQ(released[2].sample.stamp, Timestamp{45ms});
}

TEST(ImuOrder, givesTheBodysSamplesAmongTheOthersHoweverFarAheadTheyWereAdded)
{
  ImuOrder order;
  order.addBody(
      {imu(SensorImu::kBody, 10ms).sample, imu(SensorImu::kBody, 50ms).sample, imu(SensorImu::kBody, 60ms).sample});
  order.add(imu(0, 20ms));
  order.add(imu(0, 40ms));
  const auto released = order.release(Timestamp{30ms});
  ASSERT_EQ(released.size(), 2u);
  EXPECT_EQ(released[0].sample.stamp, Timestamp{10ms});
  EXPECT_EQ(released[1].sensor, 0);
  EXPECT_EQ(order.release(Timestamp::max()).size(), 3u);
  EXPECT_EQ(order.late(), 0u);
}
}  // namespace scanloom::imu_order_unittest
