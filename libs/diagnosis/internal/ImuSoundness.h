/** Whether an IMU by itself measures what an IMU on a machine can: units, axes, signs. */
#pragma once
#include "base/core/Finding.h"
#include "base/core/Rigid.h"
#include "estimation/imu/GyroScale.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct ImuSoundness
{
  Duration span{0};
  Eigen::Vector3d force_in_body = Eigen::Vector3d::Zero();  // mean specific force
  std::optional<GyroScale> gyro_scale;
  double sustained_rate = 0;  // rad/s: the largest mean turn rate over 5 s
};

/** Samples in the order of their stamps. */
ImuSoundness soundnessOf(const std::vector<ImuSample>&, const Rigid& body_T_imu);

Finding gravityFinding(const std::string& imu, const ImuSoundness&);
Finding gyroFinding(const std::string& imu, const ImuSoundness&);

/** `configured`: pose of the IMU, or of the lidar that holds it. */
Finding upFinding(const std::string& imu, const ImuSoundness&, const Rigid& configured);

/** What to do about turn rates that are `ratio` times the true ones, within this factor; none if that is no unit. */
std::optional<std::string> mendOfTurnRates(double ratio, double factor);

/**
 * What to do if the angles of a pose were given in radians: read so, `up_in_body`, which is far from the body's z,
 * would be near it. Else none.
 */
std::optional<std::string> mendOfRadians(const Rigid& configured, const Eigen::Vector3d& up_in_body);
}  // namespace scanloom
