/** Damped Gauss-Newton on the distribution-to-distribution objective. */
#pragma once
#include "ndt/NormalEquations.h"
#include "ndt/Registration.h"

#include <vector>

namespace scanloom
{
struct Minimum
{
  Rigid target_T_source;
  NormalEquations equations;  // there, or a step below the tolerance before
  int iterations = 0;
  bool converged = false;
};

/** A guess with a covariance as a part of the objective; nothing, for one without. */
class Expectation
{
 public:
  Expectation() = default;
  explicit Expectation(const PoseGuess&);

  void addTo(NormalEquations&, const Rigid& target_T_source, double d2) const;

 private:
  Rigid pose_;
  Matrix6d information_ = Matrix6d::Zero();
};

/** Never steps along the `locked` directions (orthonormal, in metres). Leaves the neighbourhoods at the minimum. */
Minimum minimise(Neighbourhoods&, const Rigid& start, const Expectation&, const RegistrationOptions&,
                 const std::vector<Vector6d>& locked);

/** The same of several pairs of maps at once: one pose for all. */
Minimum minimise(std::vector<Neighbourhoods>&, const Rigid& start, const RegistrationOptions&);
}  // namespace scanloom
