#include "slam/LostMotion.h"

#include "core/Angle.h"
#include "core/So3.h"
#include "imu/NavState.h"

#include <gtest/gtest.h>

namespace scanloom::lost_motion_unittest
{
using namespace std::chrono_literals;

namespace
{
/** Of a body at rest, upright, for which this attitude is held. */
LostMotion byGravity(const Eigen::Quaterniond& map_R_body, Duration within)
{
  return {seconds(within) * (map_R_body * -gravityInMap() + gravityInMap()), within};
}
}  // namespace

TEST(LostMotion, theVelocityThatGravityGivesAlongAnErrorOfTheTiltTellsThatError)
{
  for (const double degrees : {2.0, 7.0, 16.0})
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, -0.8, 0)})
    {
      const Eigen::Quaterniond tilted = expSo3(degrees * kDegree * axis);
      const Attitude attitude = levelled(tilted, byGravity(tilted, 12s));
      EXPECT_LT(attitude.map_R_body.angularDistance(Eigen::Quaterniond::Identity()), 1e-9) << degrees;
      EXPECT_NEAR(attitude.tilt_sigma, 3 / (12 * kGravity), 1e-9);
    }
}

TEST(LostMotion, whatAMachineCanGainLeavesTheAttitudeAsItIs)
{
  const Eigen::Quaterniond attitude = expSo3(Eigen::Vector3d(0.2, 0.1, 3));
  const LostMotion motion{{2.9, 0, 0}, 12s};
  EXPECT_EQ(levelled(attitude, motion).map_R_body.coeffs(), attitude.coeffs());
  EXPECT_EQ(levelled(attitude, motion).tilt_sigma, 0);
}
}  // namespace scanloom::lost_motion_unittest
