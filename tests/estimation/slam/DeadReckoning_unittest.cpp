#include "estimation/slam/internal/DeadReckoning.h"

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "estimation/imu/NavState.h"

#include <gtest/gtest.h>

namespace scanloom::dead_reckoning_unittest
{
using namespace std::chrono_literals;

namespace
{
/** Of a body at rest, upright, for which this attitude is held. */
DeadReckoning byGravity(const Eigen::Quaterniond& map_R_body, Duration within)
{
  return {seconds(within) * (map_R_body * -gravityInMap() + gravityInMap()), within};
}
}  // namespace

TEST(DeadReckoning, theVelocityThatGravityGivesAlongAnErrorOfTheTiltTellsThatError)
{
  for (const double degrees : {2.0, 7.0, 16.0})
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, -0.8, 0)})
    {
      const Eigen::Quaterniond tilted = expSo3(degrees * kDegree * axis);
      const Attitude attitude = levelledByMeanForce(tilted, byGravity(tilted, 12s));
      EXPECT_LT(attitude.map_R_body.angularDistance(Eigen::Quaterniond::Identity()), 1e-9) << degrees;
      EXPECT_NEAR(attitude.tilt_sigma, 3 / (12 * kGravity), 1e-9);
    }
}

TEST(DeadReckoning, whatAMachineCanGainLeavesTheAttitudeAsItIs)
{
  const Eigen::Quaterniond attitude = expSo3(Eigen::Vector3d(0.2, 0.1, 3));
  const DeadReckoning motion{{2.9, 0, 0}, 12s};
  EXPECT_EQ(levelledByMeanForce(attitude, motion).map_R_body.coeffs(), attitude.coeffs());
  EXPECT_EQ(levelledByMeanForce(attitude, motion).tilt_sigma, 0);
}
}  // namespace scanloom::dead_reckoning_unittest
