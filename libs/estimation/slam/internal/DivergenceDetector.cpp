#include "estimation/slam/internal/DivergenceDetector.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"

#include <cmath>

namespace scanloom
{
namespace
{
bool isBeyond(double metres, double radians, const Vector6d& apart)
{
  return apart.head<3>().norm() > metres || apart.tail<3>().norm() > radians;
}
}  // namespace

void DivergenceDetector::add(const Vector6d& apart, const Matrix6d& covariance)
{
  const std::optional<Vector6d> weighed = solvePositive(covariance, apart);
  if (!weighed) return;
  const double deviations = std::sqrt(apart.dot(*weighed));
  // Deviations alone do not matter where both are certain.
  const bool is_apart = isBeyond(fitted::kApart, fitted::kApartRadians, apart) && deviations > fitted::kApartDeviations;
  far_ = is_apart &&
         (isBeyond(fitted::kFarApart, fitted::kFarApartRadians, apart) || deviations > fitted::kFarApartDeviations);
  evidence_ = is_apart ? evidence_ + (far_ ? 2 : 1) : 0;
}

Divergence DivergenceDetector::level() const
{
  if (evidence_ >= 6) return Divergence::Persistent;
  if (far_ || evidence_ >= 4) return Divergence::Apparent;
  return evidence_ > 0 ? Divergence::Suspected : Divergence::None;
}
}  // namespace scanloom
