/** How far the headings of registrations can be trusted, where a lidar sees more on one side than on the other. */
#pragma once
#include "core/Matrix6.h"
#include "ndt/Registration.h"

namespace scanloom
{
/**
 * What is seen from one side displaces a registration sideways (RegistrationResult::one_sided), and differently so at
 * the map's begin and at its end, because both were seen from elsewhere. The heading then errs by about the
 * displacement over the map's length, in the same way for all registrations to that map: their number does not lessen
 * it, and every keyframe hands it on. A gyroscope errs less. With a lidar on each side the displacements cancel, and so
 * does the doubt.
 */
class HeadingDoubt
{
 public:
  /** `map_begin`: position of the map's oldest keyframe; `travel`: m since the registration before. */
  void add(const RegistrationResult&, const Eigen::Vector3d& up_in_source, const Eigen::Vector3d& map_begin,
           double travel);

  /** rad, of the error that all registrations to the map share. */
  double deviation() const;

  /** m, on which registrations share it. */
  double length() const { return length_; }

 private:
  double sideways_ = 0;  // m, mean over the length of the map
  double length_ = 0;
};

/** The fine registration's pose, its heading weighted with that of the estimate by the doubt. */
Rigid withHeadingOf(const Rigid& estimate, const RegistrationResult& fine, const Eigen::Vector3d& up_in_source,
                    const HeadingDoubt&);
}  // namespace scanloom
