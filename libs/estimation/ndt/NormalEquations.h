/** The objective near a pose in the form that the minimiser needs: with B held constant. */
#pragma once
#include "base/core/Rigid.h"
#include "estimation/ndt/CellCorrespondences.h"

namespace scanloom
{
struct NormalEquations
{
  double value = 0;                       // -sum exp(-d2/2 m'Bm) (doc/registration.md)
  Vector6d gradient = Vector6d::Zero();   // in the tangent of boxPlus
  Matrix6d curvature = Matrix6d::Zero();  // Gauss-Newton: sum w J' B J, never indefinite
  double met_points = 0;                  // points in source cells that match a target cell: m'Bm < 2 / d2
};

/** Moves the correspondences to the pose. Sums over fixed chunks of cells are added in a fixed order. */
NormalEquations normalEquations(CellCorrespondences&, const Rigid& target_T_source, double d2);

/** From steps of boxPlus at the pose, in the source's frame, to steps about the source's origin in the target's. */
Matrix6d targetOfStep(const Rigid& target_T_source);
}  // namespace scanloom
