/**
 * The distribution-to-distribution objective with its exact derivatives (T. Stoyanov: Reliable autonomous navigation
 * in semi-structured environments using the 3D-NDT, PhD thesis, Orebro 2012, chapter 6), to compare the
 * approximations of align() with.
 *
 *   f = sum over pairs of -exp(-d2/2 m' B m),  m = R mu_source + t - mu_target,  B = (R C_source R' + C_target)^-1
 */
#pragma once
#include "base/core/Rigid.h"
#include "estimation/ndt/internal/GaussianCell.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
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

using Eigen::Matrix3d;
using Eigen::Vector3d;

/**
 * q = m' B m of one pair and its derivatives. Everything is turned into the source's frame, where C_source stands
 * still, C_target turns with R' and a step moves mu to exp(step_r) mu + step_t.
 */
struct Mahalanobis
{
  double q;
  Vector6d gradient;
  Matrix6d hessian;
};

struct StepDerivatives
{
  std::array<Vector3d, 6> residual;    // d m / d step_i
  std::array<Matrix3d, 6> covariance;  // d (exp C exp') / d step_i
};

inline StepDerivatives firstDerivatives(const GaussianCell& source)
{
  StepDerivatives d;
  for (int i = 0; i < 3; ++i)
  {
    const Matrix3d turn = skew(Vector3d::Unit(i));
    d.residual[i] = Vector3d::Unit(i);
    d.covariance[i].setZero();
    d.residual[3 + i] = turn * source.mean;
    d.covariance[3 + i] = turn * source.covariance - source.covariance * turn;
  }
  return d;
}

/** u' (d2 C / d step_i d step_j) u and d2 m / d step_i d step_j . u for two rotations about the axes i and j. */
inline double secondDerivative(const GaussianCell& source, const Vector3d& u, int i, int j)
{
  const Matrix3d turn_i = skew(Vector3d::Unit(i)), turn_j = skew(Vector3d::Unit(j));
  const Matrix3d both = (turn_i * turn_j + turn_j * turn_i) / 2;
  const Matrix3d& c = source.covariance;
  const Matrix3d covariance = both * c + c * both - turn_i * c * turn_j - turn_j * c * turn_i;
  return 2 * u.dot(both * source.mean) - u.dot(covariance * u);
}

inline Mahalanobis mahalanobis(const CellPair& pair, const Matrix3d& rotation, const Vector3d& translation)
{
  const Vector3d m = pair.source.mean + rotation.transpose() * (translation - pair.target.mean);
  const Matrix3d b = (pair.source.covariance + rotation.transpose() * pair.target.covariance * rotation).inverse();
  const Vector3d u = b * m;
  const StepDerivatives d = firstDerivatives(pair.source);

  Mahalanobis result;
  result.q = m.dot(u);
  for (int i = 0; i < 6; ++i)
  {
    result.gradient[i] = 2 * d.residual[i].dot(u) - u.dot(d.covariance[i] * u);
    for (int j = 0; j < 6; ++j)
    {
      const Vector3d a_i = d.residual[i] - d.covariance[i] * u, a_j = d.residual[j] - d.covariance[j] * u;
      result.hessian(i, j) = 2 * a_i.dot(b * a_j);
      if (i >= 3 && j >= 3) result.hessian(i, j) += secondDerivative(pair.source, u, i - 3, j - 3);
    }
  }
  return result;
}
inline D2dCost d2dCost(const std::vector<CellPair>& pairs, const Rigid& target_T_source, double d2)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  D2dCost cost;
  for (const CellPair& pair : pairs)
  {
    const Mahalanobis m = mahalanobis(pair, rotation, target_T_source.translation);
    const double e = std::exp(-d2 / 2 * m.q);
    cost.value -= e;
    cost.gradient += d2 / 2 * e * m.gradient;
    cost.hessian += d2 / 2 * e * (m.hessian - d2 / 2 * m.gradient * m.gradient.transpose());
  }
  return cost;
}
}  // namespace scanloom
