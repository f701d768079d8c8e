#include "estimation/graph/ImuFactor.h"

#include "estimation/graph/checkFactor.h"

namespace scanloom::imu_factor_unittest
{
namespace
{
const AnalyticDrive kDrive;
const ImuBias kBias{{0.02, -0.03, 0.01}, {0.1, -0.2, 0.15}};
const Timestamp kFrom{1s}, kTo{1500ms};

Preintegration motionOfDrive() { return preintegrate(kDrive.samples(kFrom, kTo, 5ms, kBias), kBias, {}); }
}  // namespace

TEST(ImuFactor, jacobianEqualsCentralDifferences)
{
  // Every residual of one weight, else the sharp ones would hide errors in the others.
  Preintegration motion = motionOfDrive();
  motion.covariance.setIdentity();
  ImuNoise noise;
  noise.gyro_bias_walk_deg = 180 / M_PI / std::sqrt(motion.duration());
  noise.accel_bias_walk = 1 / std::sqrt(motion.duration());

  checkFactor(std::make_unique<ImuFactor>(motion, noise),
              {disturbed(kDrive.stateAt(kFrom, kBias), 0.2, 1), disturbed(kDrive.stateAt(kTo, kBias), 0.3, 2)});
}

TEST(ImuFactor, whitenedJacobianEqualsCentralDifferences)
{
  const Preintegration motion = motionOfDrive();
  checkFactor(std::make_unique<ImuFactor>(motion, ImuNoise{}),
              {disturbed(kDrive.stateAt(kFrom, kBias), 0.01, 1), disturbed(kDrive.stateAt(kTo, kBias), 0.01, 2)});
}

TEST(ImuFactor, isSatisfiedByThePrediction)
{
  const Preintegration motion = motionOfDrive();
  const ImuBias moved{kBias.gyro + Eigen::Vector3d(1e-3, 2e-3, -1e-3), kBias.accel + Eigen::Vector3d(0.02, 0, 0.01)};
  const NavState from = kDrive.stateAt(kFrom, moved);
  EXPECT_LT(residualOf(ImuFactor(motion, {}), {from, predict(from, motion)}).norm(), 1e-7);  // sigmas
}

TEST(ImuFactor, weighsAnErrorByTheCovarianceOfTheMotion)
{
  const Preintegration motion = motionOfDrive();
  const ImuNoise noise;
  const NavState from = kDrive.stateAt(kFrom, kBias);
  NavState to = predict(from, motion);
  to.bias.gyro.x() += 3 * noise.gyro_bias_walk_deg * M_PI / 180 * std::sqrt(0.5);
  to.bias.accel.y() += 4 * noise.accel_bias_walk * std::sqrt(0.5);
  EXPECT_NEAR(residualOf(ImuFactor(motion, noise), {from, to}).norm(), 5, 1e-6);

  to = predict(from, motion);
  const Eigen::Vector3d error(1e-3, -2e-3, 5e-4);
  to.velocity += from.map_T_imu.rotation * error;
  const Matrix9d information = motion.covariance.inverse();
  const double squared = error.dot(information.block<3, 3>(3, 3) * error);
  EXPECT_NEAR(residualOf(ImuFactor(motion, noise), {from, to}).squaredNorm() / squared, 1, 0.01);
}

TEST(ImuFactor, isFiniteForASingleStepWhoseCovarianceIsSingular)
{
  const Preintegration motion = preintegrate(kDrive.samples(kFrom, kFrom + 5ms, 5ms), {}, {});
  const NavState from = kDrive.stateAt(kFrom);
  EXPECT_LT(residualOf(ImuFactor(motion, {}), {from, predict(from, motion)}).norm(), 1e-6);
  EXPECT_TRUE(residualOf(ImuFactor(motion, {}), {from, disturbed(from, 0.1, 3)}).allFinite());
}
}  // namespace scanloom::imu_factor_unittest
