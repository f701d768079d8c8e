/** How far the headings of registrations can be trusted, where a lidar sees more on one side than on the other. */
#pragma once
#include "core/Matrix6.h"
#include "ndt/Registration.h"

namespace scanloom
{
/**
 * What is seen from one side displaces a registration sideways (RegistrationResult::one_sided): by other amounts where
 * the map begins than where it ends, because the machine saw both from different places. So the heading errs by some
 * such displacements over the length of the map. All registrations to that map share this error: more of them do not
 * lessen it, and every keyframe hands it on. A gyroscope errs less. With a lidar on each side the displacements cancel,
 * and the doubt is near zero.
 */
class HeadingDoubt
{
 public:
  /** `map_begin`: position of the map's oldest keyframe; `travel`: m since the registration before. */
  void add(const RegistrationResult&, const Eigen::Vector3d& up_in_source, const Eigen::Vector3d& map_begin,
           double travel);

  /** rad, standard deviation of the heading error that all registrations to the map share. */
  double deviation() const;

  /** m, of the map: registrations on so much way share the error. */
  double length() const { return length_; }

 private:
  double sideways_ = 0;  // m, mean over the length of the map
  double length_ = 0;
};

/**
 * The pose of the fine registration, but the heading is a mean of its own and the estimate's: the more doubt, the
 * nearer to the estimate's.
 */
Rigid withHeadingOf(const Rigid& estimate, const RegistrationResult& fine, const Eigen::Vector3d& up_in_source,
                    const HeadingDoubt&);
}  // namespace scanloom
