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

/** Never steps along the `locked` directions (orthonormal, in metres). Leaves the neighbourhoods at the minimum. */
Minimum minimise(Neighbourhoods&, const Rigid& guess, const RegistrationOptions&, const std::vector<Vector6d>& locked);

/** The same of several pairs of maps at once: one pose for all. */
Minimum minimise(std::vector<Neighbourhoods>&, const Rigid& guess, const RegistrationOptions&,
                 const std::vector<Vector6d>& locked);
}  // namespace scanloom
