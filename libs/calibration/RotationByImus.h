/** The rotation between two lidars by the IMUs in them, which measure the same turn rate and the same gravity. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** An IMU inside a lidar: its readings (rad/s, m/s2), and its pose in the lidar by the lidar's metadata. */
struct LidarImu
{
  Rigid lidar_T_imu;
  std::vector<ImuSample> samples;
};

/** Unit vector up in the lidar's frame, by the mean of its accelerometer's readings. None without them. */
std::optional<Eigen::Vector3d> upIn(const LidarImu&);

/** What the IMUs tell of a lidar's rotation, if that of the reference lidar on the body is right. */
struct RotationByImus
{
  struct ByGyroscopes
  {
    Eigen::Quaterniond body_R_lidar;
    double sigma;  // rad, about the least certain axis
  };
  struct ByGravity
  {
    Eigen::Vector3d up_in_body, up_in_lidar;  // unit
  };
  std::optional<ByGyroscopes> turns;  // none: no gyroscopes, too few turns, or about one axis only, or left-handed
  std::optional<ByGravity> gravity;   // none: no accelerometers
};

RotationByImus rotationByImus(const LidarImu& of_lidar, const LidarImu& of_reference, const Rigid& body_T_reference);

/**
 * Whether the IMUs exclude this rotation: by more than 4 standard deviations and 2 deg, as which an IMU may be mounted
 * otherwise in its lidar than the metadata say, or plumb lines more than 4 deg apart (biases of 0.03 g).
 */
bool contradicts(const RotationByImus&, const Eigen::Quaterniond& body_R_lidar);
}  // namespace scanloom
