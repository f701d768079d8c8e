/**
 * The distribution-to-distribution objective with its exact derivatives (T. Stoyanov: Reliable autonomous navigation
 * in semi-structured environments using the 3D-NDT, PhD thesis, Orebro 2012, chapter 6): the measure of every shortcut
 * that align() takes.
 *
 *   f = sum over pairs of -exp(-d2/2 m' B m),  m = R mu_source + t - mu_target,  B = (R C_source R' + C_target)^-1
 */
#pragma once
#include "core/Rigid.h"
#include "ndt/GaussianCell.h"

#include <vector>

namespace scanloom
{
struct CellPair
{
  GaussianCell target, source;
};

struct D2dCost
{
  double value = 0;
  Vector6d gradient = Vector6d::Zero();  // in the tangent of boxPlus
  Matrix6d hessian = Matrix6d::Zero();   // full Newton: indefinite far from the optimum
};

D2dCost d2dCost(const std::vector<CellPair>&, const Rigid& target_T_source, double d2);
}  // namespace scanloom
