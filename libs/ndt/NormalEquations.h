/** The objective near a pose in the form that the minimiser needs, B held, at a fraction of d2dCost's price. */
#pragma once
#include "core/Rigid.h"
#include "ndt/Neighbourhoods.h"

namespace scanloom
{
struct NormalEquations
{
  double value = 0;                       // f, exactly as d2dCost
  Vector6d gradient = Vector6d::Zero();   // with B held, in the tangent of boxPlus
  Matrix6d curvature = Matrix6d::Zero();  // Gauss-Newton: sum w J' B J, never indefinite
  double met_points = 0;                  // in source cells with a target cell within the score's reach, m'Bm < 2 / d2
};

/** Moves the neighbourhoods to the pose. Sums run over fixed chunks of cells in a fixed order, on all threads. */
NormalEquations normalEquations(Neighbourhoods&, const Rigid& target_T_source, double d2);

/** Takes steps of boxPlus at the pose, in the source's frame, to steps about the source's origin in the target's. */
Matrix6d targetOfStep(const Rigid& target_T_source);
}  // namespace scanloom
