#include "slam/HeadingDoubt.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// By how many times the displacement (of cells one deviation farther away) the heading is doubted. Fitted to the
// headings of drives of 120 to 315 m with one lidar (doc/study/localisation.md): with 1 they err up to three times as
// much.
constexpr double kDeviations = 4;
constexpr double kSight = 12;  // m: on less way the same is seen from the same side
}  // namespace

void HeadingDoubt::add(const RegistrationResult& seen, const Eigen::Vector3d& up_in_source,
                       const Eigen::Vector3d& map_begin, double travel)
{
  const Eigen::Vector3d back =
      seen.target_T_source.rotation.conjugate() * (map_begin - seen.target_T_source.translation);
  length_ = std::max(back.norm(), kSight);
  const Eigen::Vector3d across = up_in_source.cross(back);
  if (!(across.norm() > 0)) return;
  sideways_ += std::min(1.0, travel / length_) * (across.normalized().dot(seen.one_sided) - sideways_);
}

double HeadingDoubt::deviation() const { return length_ > 0 ? kDeviations * std::abs(sideways_) / length_ : 0; }

Rigid withHeadingOf(const Rigid& estimate, const RegistrationResult& fine, const Eigen::Vector3d& up_in_source,
                    const HeadingDoubt& doubt)
{
  const double shared = std::pow(doubt.deviation(), 2);
  if (shared == 0) return fine.target_T_source;
  const double own = up_in_source.dot(fine.covariance.bottomRightCorner<3, 3>() * up_in_source);
  const double turn = up_in_source.dot(boxMinus(estimate, fine.target_T_source).tail<3>());
  Vector6d step = Vector6d::Zero();
  step.tail<3>() = shared / (shared + own) * turn * up_in_source;
  return boxPlus(fine.target_T_source, step);
}
}  // namespace scanloom
