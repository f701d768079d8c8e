#pragma once
#include "base/core/Time.h"

#include <Eigen/Core>

namespace scanloom
{
/** One reading of an inertial measurement unit, in the IMU's own frame. */
struct ImuSample
{
  Timestamp stamp;
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // m/s2, specific force: at rest it points up with 9.81
  bool after_refused = false;                       // readings between the sample before and this one were refused
};
}  // namespace scanloom
