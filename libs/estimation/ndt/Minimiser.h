/** Damped Gauss-Newton minimisation of the distribution-to-distribution objective. */
#pragma once
#include "estimation/ndt/NormalEquations.h"
#include "estimation/ndt/Registration.h"

#include <vector>

namespace scanloom
{
struct Minimum
{
  Rigid target_T_source;
  NormalEquations equations;  // there, or a step smaller than the tolerance before it
  int iterations = 0;
  bool converged = false;
};

/** The part of the objective by a guess; zero for a guess without a covariance. */
class PosePrior
{
 public:
  PosePrior() = default;
  explicit PosePrior(const PoseGuess&);

  bool isGiven() const { return !information_.isZero(0); }

  NormalEquations addedTo(NormalEquations, const Rigid& target_T_source, double d2) const;

 private:
  Rigid pose_;
  Matrix6d information_ = Matrix6d::Zero();
};

/** Never steps along the `locked` directions (orthonormal, in metres). Moves the correspondences to the minimum. */
Minimum minimise(CellCorrespondences&, const Rigid& start, const PosePrior&, const RegistrationOptions&,
                 const std::vector<Vector6d>& locked);

/** One pose for several pairs of maps. */
Minimum minimise(std::vector<CellCorrespondences>, const Rigid& start, const RegistrationOptions&);
}  // namespace scanloom
