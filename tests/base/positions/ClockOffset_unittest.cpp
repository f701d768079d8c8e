#include "base/positions/ClockOffset.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::clock_offset_unittest
{
namespace
{
const Eigen::Vector3d kPrism(-1, 0.5, 4);

/** Along x over time: `x` of seconds. A pose every 100 ms for a minute, turned by nothing. */
template <typename X>
Trajectory along(const X& x)
{
  Trajectory trajectory;
  for (Duration t{0}; t <= 60s; t += 100ms)
    trajectory.push_back({Timestamp{t}, {Eigen::Quaterniond::Identity(), {x(seconds(t)), 0, 0}}});
  return trajectory;
}

/** The same at 7 Hz, in another frame, its stamps late by 123 ms. */
template <typename X>
PositionTrack lateStation(const X& x)
{
  const Rigid station_T_map = Rigid::fromXyzYawPitchRoll(512, -87, 44, 2.4, 0, 0);
  PositionTrack track;
  for (Duration t = 30ms; t < 60s; t += 143ms)
    track.push_back({Timestamp{t + 123ms}, station_T_map * (Eigen::Vector3d(x(seconds(t)), 0, 0) + kPrism)});
  return track;
}

TEST(ClockOffset, isFoundWhereTheVelocityChanges)
{
  const auto x = [](double t) { return 5 * std::sin(0.3 * t); };

  const auto offset = clockOffset(along(x), kPrism, lateStation(x));

  ASSERT_TRUE(offset);
  EXPECT_NEAR(seconds(*offset), 0.123, 0.001);
}

TEST(ClockOffset, cannotBeToldAtRestOrAtConstantVelocity)
{
  for (const double speed : {0.0, 1.0})
  {
    const auto x = [speed](double t) { return speed * t; };
    EXPECT_FALSE(clockOffset(along(x), kPrism, lateStation(x))) << speed << " m/s";
  }
}

TEST(ClockOffset, cannotBeToldWithoutTimeInCommon) { EXPECT_FALSE(clockOffset({}, kPrism, {})); }
}  // namespace
}  // namespace scanloom::clock_offset_unittest
