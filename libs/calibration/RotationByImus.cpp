#include "calibration/RotationByImus.h"

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "estimation/imu/GyroAgreement.h"
#include "estimation/imu/MeanForce.h"

namespace scanloom
{
namespace
{
constexpr double kSigmas = 4, kMostTurn = 2 * kDegree, kMostTilt = 4 * kDegree;

std::optional<RotationByImus::ByGyroscopes> byGyroscopes(const LidarImu& of_lidar, const LidarImu& of_reference,
                                                         const Rigid& body_T_reference)
{
  const std::optional<GyroAgreement> turns = gyroAgreement(
      {of_reference.samples, body_T_reference * of_reference.lidar_T_imu}, {of_lidar.samples, of_lidar.lidar_T_imu});
  if (!turns || turns->mirrored) return std::nullopt;
  return RotationByImus::ByGyroscopes{expSo3(turns->rotation), turns->sigma};
}
}  // namespace

std::optional<Eigen::Vector3d> upIn(const LidarImu& imu)
{
  const std::optional<Eigen::Vector3d> force = meanForce(imu.samples);
  if (!force || forceUnitOf(force->norm()) != ForceUnit::MetresPerSecondSquared) return std::nullopt;
  return imu.lidar_T_imu.rotation * force->normalized();
}

RotationByImus rotationByImus(const LidarImu& of_lidar, const LidarImu& of_reference, const Rigid& body_T_reference)
{
  RotationByImus rotation{byGyroscopes(of_lidar, of_reference, body_T_reference), std::nullopt};
  const std::optional<Eigen::Vector3d> up = upIn(of_reference), up_in_lidar = upIn(of_lidar);
  if (up && up_in_lidar) rotation.gravity = RotationByImus::ByGravity{body_T_reference.rotation * *up, *up_in_lidar};
  return rotation;
}

bool contradicts(const RotationByImus& imus, const Eigen::Quaterniond& body_R_lidar)
{
  if (imus.turns && imus.turns->body_R_lidar.angularDistance(body_R_lidar) > kSigmas * imus.turns->sigma + kMostTurn)
    return true;
  return imus.gravity && imus.gravity->up_in_body.dot(body_R_lidar * imus.gravity->up_in_lidar) < std::cos(kMostTilt);
}
}  // namespace scanloom
