/** The rotation between two lidars by the IMUs in them, on a body whose turns are known at every instant. */
#include "calibration/RotationByImus.h"

#include "base/core/Angle.h"
#include "calibration/seenInWorld.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom::rotation_by_imus_unittest
{
namespace
{
const Rigid kLeft = at(1.5, 1.2, 2.5, 30, 15, -25), kRight = at(1.5, -1.2, 2.5, -30, 15, 25);
const Rigid kLidarTImu = at(0.01, -0.01, 0.04, 0, 0, 180);

/** 40 s of a body that winds and sways (rad/s about z, y and x), read with the noise and biases of a cheap IMU. */
LidarImu imuIn(const Rigid& body_T_lidar, std::uint64_t seed, double sway)
{
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, 0.003);
  LidarImu imu{kLidarTImu, {}};
  const Eigen::Quaterniond imu_R_body = (body_T_lidar * kLidarTImu).rotation.conjugate();
  for (int i = 0; i < 4000; ++i)
  {
    const double t = 0.01 * i;
    const Eigen::Vector3d rate(sway * std::sin(3 * t), sway * std::sin(2 * t + 1), 0.2 * std::sin(0.3 * t));
    const Eigen::Vector3d error(noise(random), noise(random), noise(random));
    imu.samples.push_back({Timestamp{i * 10ms}, imu_R_body * rate + error + Eigen::Vector3d(0.002, -0.001, 0.003),
                           imu_R_body * Eigen::Vector3d(0.05, 0.1, 9.81)});
  }
  return imu;
}

RotationByImus byImus(double sway) { return rotationByImus(imuIn(kRight, 1, sway), imuIn(kLeft, 2, sway), kLeft); }

Eigen::Quaterniond turned(double deg, const Eigen::Vector3d& axis)
{
  return Eigen::AngleAxisd(deg * kDegree, axis) * kRight.rotation;
}
}  // namespace

TEST(RotationByImus, isToldByGyroscopesToATenthOfADegree)
{
  const RotationByImus imus = byImus(0.05);
  ASSERT_TRUE(imus.turns);
  const double error = imus.turns->body_R_lidar.angularDistance(kRight.rotation);
  EXPECT_LT(error, 4 * imus.turns->sigma);
  EXPECT_LT(error / kDegree, 0.2);
}

TEST(RotationByImus, contradictsAHeadingThatGyroscopesExclude)
{
  const RotationByImus imus = byImus(0.05);
  EXPECT_FALSE(contradicts(imus, turned(1, Eigen::Vector3d::UnitZ())));
  EXPECT_TRUE(contradicts(imus, turned(5, Eigen::Vector3d::UnitZ())));
}

TEST(RotationByImus, ofABodyThatTurnsAboutOneAxisIsToldByGravityExceptForTheHeading)
{
  const RotationByImus imus = byImus(0);
  EXPECT_FALSE(imus.turns);
  ASSERT_TRUE(imus.gravity);
  EXPECT_FALSE(contradicts(imus, turned(90, Eigen::Vector3d::UnitZ())));
  EXPECT_TRUE(contradicts(imus, turned(6, Eigen::Vector3d::UnitX())));
}

TEST(RotationByImus, ofLidarsWithoutImusIsNotKnown)
{
  const RotationByImus imus = rotationByImus({}, {}, kLeft);
  EXPECT_FALSE(imus.turns || imus.gravity);
  EXPECT_FALSE(contradicts(imus, turned(90, Eigen::Vector3d::UnitX())));
}
}  // namespace scanloom::rotation_by_imus_unittest
