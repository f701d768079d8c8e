#include "estimation/slam/internal/DivergenceDetector.h"

#include "base/core/Decompositions.h"

#include <cmath>

namespace scanloom
{
namespace
{
/** An estimate and its registration are apart by more than these. Deviations alone do not matter where both are
 * certain. */
struct Limits
{
  double metres, radians;
};
constexpr Limits kApart{0.1, 0.02}, kFarApart{0.25, 0.05};  // good drives with one lidar: up to 0.21 m for a scan
constexpr double kDeviations = 8, kManyDeviations = 15;     // and up to 13

bool isBeyond(const Limits& limits, const Vector6d& apart)
{
  return apart.head<3>().norm() > limits.metres || apart.tail<3>().norm() > limits.radians;
}
}  // namespace

void DivergenceDetector::add(const Vector6d& apart, const Matrix6d& covariance)
{
  const std::optional<Vector6d> weighed = solvePositive(covariance, apart);
  if (!weighed) return;
  const double deviations = std::sqrt(apart.dot(*weighed));
  const bool is_apart = isBeyond(kApart, apart) && deviations > kDeviations;
  far_ = is_apart && (isBeyond(kFarApart, apart) || deviations > kManyDeviations);
  evidence_ = is_apart ? evidence_ + (far_ ? 2 : 1) : 0;
}

Divergence DivergenceDetector::level() const
{
  if (evidence_ >= 6) return Divergence::Persistent;
  if (far_ || evidence_ >= 4) return Divergence::Apparent;
  return evidence_ > 0 ? Divergence::Suspected : Divergence::None;
}
}  // namespace scanloom
