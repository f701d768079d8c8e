#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Keyframe.h"
#include "base/core/StampedPose.h"
#include "estimation/imu/NavState.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/Registration.h"

#include <optional>
#include <string>

namespace scanloom
{
enum class Health
{
  Initialising,  // the start was neither at rest nor long enough: gravity and biases are rough
  Ok,
  Degenerate,  // the lidar leaves a direction open, this scan is not trusted, or IMU and lidar are apart (assess())
  Lost,        // the pose has been the IMU's alone for too long
};
std::string toString(Health);

/** The machine at the end of a processed scan. More than a dozen members: it is all that a run reports of a scan. */
struct StateEstimate
{
  Timestamp stamp;  // the scan's end, when the body was at map_T_body
  Rigid map_T_body;
  /**
   * Covariance of boxMinus(truth, estimate): translation (m), rotation (rad), along the body's axes. Both are poses in
   * the local map, whose own errors are not included. Without an anchor, as before the first keyframe or with relative
   * = false, it is of map_T_body.
   */
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d since_start = Matrix6d::Zero();  // the same of the pose relative to the first one
  Vector6d correction = Vector6d::Zero();   // boxMinus(map_T_body, the IMU's prediction from the previous estimate)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the IMU, in the map frame
  ImuBias imu_bias;                                    // by which its next readings are predicted
  std::optional<ImuSample> imu;  // its reading at `stamp`, interpolated; none where there is no IMU
  Rigid body_T_imu;
  Health health = Health::Ok;
  bool scan_complete = true;
  bool imu_complete = true;  // false: the IMU did not cover the scan in time, its last reading was held
  PointCloud cloud;          // in the body frame at `stamp`, from which its t count: cropped and deskewed
  std::optional<RegistrationResult> registration;  // none for the first scan of a map, or one without points
  double mahalanobis = 0;      // distance of the registration from the IMU's prediction, in standard deviations
  bool trusted = false;        // the registration, by its outcome and this distance
  double map_shift = 0;        // m, by which the body moved because the local map was levelled anew
  bool recovered = false;      // found again: the pose does not continue the previous one
  bool map_restarted = false;  // a new local map begins here
  bool in_map = false;         // the map frame is that of an earlier drive's map
  bool entered_map = false;    // in_map, and the estimate before was not
  std::optional<Keyframe> keyframe;
  Matrix6d keyframe_covariance = Matrix6d::Zero();  // of its pose in the local map that it joins, tangent of boxPlus
  Trajectory since_last;  // body poses at the IMU's stamps, after the previous estimate up to this one

  /** The pose does not continue the one before: the body did not move from there to here. */
  bool leaps() const { return recovered || map_restarted || entered_map; }

  /** The map shifted farther than gravity shifts it in sound drives: accelerations were taken for a tilt, and the poses
   * before are as wrong as this one. */
  bool mapJumped() const { return map_shift > fitted::kMapJump; }
};
}  // namespace scanloom
