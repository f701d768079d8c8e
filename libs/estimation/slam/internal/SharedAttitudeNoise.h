/** How far the attitudes of registrations can be trusted: errors that all registrations to the same map share. */
#pragma once
#include "base/core/Decompositions.h"
#include "estimation/ndt/Registration.h"

namespace scanloom
{
/**
 * More registrations do not lessen these errors, and every keyframe hands them on; gravity and a gyroscope know better.
 *
 * Heading: what is seen from one side displaces a registration sideways (RegistrationResult::viewpoint_bias), by other
 * amounts where the map begins than where it ends, because the machine saw both from different places. So the heading
 * errs by such a displacement over the length of the map. With a lidar on each side the displacements cancel, and
 * this noise is near zero.
 *
 * Tilt: keyframes that lean by a little make the next registrations lean, too. If the smoother
 * follows them it takes them for a bias of the accelerometer, and that turns the heading.
 */
class SharedAttitudeNoise
{
 public:
  /** `map_begin`: position of the map's oldest keyframe; `travel`: m since the registration before. */
  void add(const RegistrationResult&, const Eigen::Vector3d& up_in_source, const Eigen::Vector3d& map_begin,
           double travel);

  /** Covariance of the error that all registrations to the map share, in the tangent of boxPlus: rad² of the rotation,
   * 0 else. */
  Matrix6d covariance(const Eigen::Vector3d& up_in_source) const;

  /** m, of the map: registrations on so much way share the error. */
  double length() const { return length_; }

 private:
  double heading() const;  // rad, standard deviation

  double sideways_ = 0;  // m, mean over the length of the map
  double length_ = 0;
};
}  // namespace scanloom
