#pragma once
#include "core/Keyframe.h"
#include "core/StampedPose.h"
#include "ndt/Registration.h"

#include <optional>
#include <string>

namespace scanloom
{
enum class Health
{
  Initialising,  // gravity and biases rest on a start that was neither at rest nor long enough
  Ok,
  Degenerate,  // the lidar leaves a direction open, or this scan was not trusted: the IMU carries it
  Lost,        // carried by the IMU alone for too long
};
std::string toString(Health);

/** The machine at the end of a processed scan. */
struct StateEstimate
{
  Timestamp stamp;  // the instant at which the body was there: the scan's end
  Rigid map_T_body;
  /**
   * Of boxMinus(truth, estimate) for the body as seen from the smoother's anchor, the body at the first keyframe or
   * where it was found again: translation (m), rotation (rad), along the body's own axes. The local map passes for
   * exact: how far its keyframes drifted is not in it, nor how far the anchor is off. For the first scan, and with
   * relative = false, it is of map_T_body.
   */
  Matrix6d covariance = Matrix6d::Zero();
  Vector6d correction = Vector6d::Zero();  // boxMinus(map_T_body, where the IMU alone saw it since the last scan)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the IMU, in the map frame
  Health health = Health::Ok;
  bool scan_complete = true;
  bool imu_complete = true;  // false: the IMU did not cover the scan in time, its last reading was held
  std::size_t points = 0;    // after the crop
  std::optional<RegistrationResult> registration;  // none for the first scan, or one without points
  double surprise = 0;                             // sigma, of the registration against what the IMU predicted
  bool trusted = false;                            // the registration, by its outcome and by that
  bool recovered = false;                          // found again: the pose does not continue the last one
  std::optional<Keyframe> keyframe;
  Trajectory since_last;  // body poses at the IMU's stamps, after the previous estimate up to this one
};
}  // namespace scanloom
