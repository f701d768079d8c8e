#include "ndt/LidarInformation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

// Points of one cell share beams, edges and the surface's own unevenness: past this number they teach nothing new.
constexpr double kMostIndependentPoints = 10;

constexpr double kTranslationFloor = 0.01;                   // m
constexpr double kRotationFloor = 0.05 * M_PI / 180 * kArm;  // m, by the arm
constexpr double kUnknownDeviation = 10;                     // m: "not measured" that still has an inverse

// Below this share of structure, the resistance against a step is that of the grid, not of the world.
constexpr double kLeastStructure = 0.25;

Matrix3d covarianceOfMean(const GaussianCell& cell)
{
  return cell.covariance / std::min<double>(cell.points, kMostIndependentPoints);
}

/** What is gathered per target cell, of which most are met by several source cells, many by none: d force / d mean. */
struct TargetRole
{
  bool met = false;
  Matrix3d force = Matrix3d::Zero(), torque = Matrix3d::Zero();
};

/** Sums over all pairs; steps in the target's frame, in m and rad, about the source's origin. */
struct Evidence
{
  Matrix6d resistance = Matrix6d::Zero();  // sum J' wB J
  Matrix6d structure = Matrix6d::Zero();   // the same of thin directions only
  Matrix6d curvature = Matrix6d::Zero();   // of the score with B held
  Matrix6d noise = Matrix6d::Zero();       // covariance of the gradient
};

/** J' A J of J = [I, -skew(v)]. */
void addTo(Matrix6d& sum, const Matrix3d& a, const Matrix3d& cross)
{
  const Matrix3d a_cross = a * cross;
  sum.topLeftCorner<3, 3>() += a;
  sum.topRightCorner<3, 3>() -= a_cross;
  sum.bottomLeftCorner<3, 3>() += cross * a;
  sum.bottomRightCorner<3, 3>() -= cross * a_cross;
}

Evidence evidenceOf(const Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  std::vector<TargetRole> roles(all.target().size());
  Evidence evidence;
  for (std::size_t i = 0; i < all.source().size(); ++i)
  {
    const auto targets = all.of(i);
    if (targets.begin() == targets.end()) continue;
    const GaussianCell& source = all.source()[i];
    const Vector3d v = rotation * source.mean, mean = v + target_T_source.translation;
    const Matrix3d covariance = rotation * source.covariance * rotation.transpose();
    const Matrix3d thin_source = rotation * source.structure * rotation.transpose();
    const Matrix3d cross = skew(v);

    Matrix3d weights = Matrix3d::Zero(), structures = Matrix3d::Zero(), pulls = Matrix3d::Zero();
    for (const std::uint32_t j : targets)
    {
      const GaussianCell& target = all.target()[j];
      const Matrix3d b = (covariance + target.covariance).inverse();
      const Vector3d m = mean - target.mean;
      const Vector3d u = b * m;
      const double w = d2 * std::exp(-d2 / 2 * m.dot(u));
      const Matrix3d pull = w * (b - d2 * u * u.transpose());
      const Matrix3d thin = thin_source * target.structure;
      weights += w * b;
      structures += w * thin * b * thin.transpose();
      pulls += pull;
      TargetRole& role = roles[j];
      role.met = true;
      role.force += pull;
      role.torque += cross * pull;
    }
    addTo(evidence.resistance, weights, cross);
    addTo(evidence.structure, structures, cross);
    addTo(evidence.curvature, pulls, cross);
    addTo(evidence.noise, pulls * rotation * covarianceOfMean(source) * rotation.transpose() * pulls, cross);
  }
  for (std::size_t j = 0; j < roles.size(); ++j)
  {
    if (!roles[j].met) continue;
    Matrix63 pull;
    pull << roles[j].force, roles[j].torque;
    evidence.noise += pull * covarianceOfMean(all.target()[j]) * pull.transpose();
  }
  return evidence;
}

/** Steps in the source's frame, in metres (see stepOfMetres). */
Evidence inSource(const Evidence& in_target, const Rigid& target_T_source)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  Matrix6d target_of_step = Matrix6d::Zero();
  target_of_step.topLeftCorner<3, 3>() = target_of_step.bottomRightCorner<3, 3>() = rotation;
  target_of_step = target_of_step * stepOfMetres().asDiagonal();
  const auto turned = [&](const Matrix6d& m) -> Matrix6d { return target_of_step.transpose() * m * target_of_step; };
  return {turned(in_target.resistance), turned(in_target.structure), turned(in_target.curvature),
          turned(in_target.noise)};
}

/** Steps whose resistance has too little structure; orthonormal. */
std::vector<Vector6d> degenerateDirections(const Evidence& evidence)
{
  const Matrix6d some = 1e-9 * (1 + evidence.resistance.trace()) * Matrix6d::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> shares(evidence.structure, evidence.resistance + some);
  std::vector<Vector6d> directions;
  for (int i = 0; i < 6 && shares.eigenvalues()[i] < kLeastStructure; ++i)
  {
    Vector6d direction = shares.eigenvectors().col(i).normalized();
    for (const Vector6d& before : directions) direction -= before.dot(direction) * before;
    directions.push_back(direction.normalized());
  }
  return directions;
}

/** Of the curvature, which far from a minimum need not be positive: what is not counts as little. */
Matrix6d safeInverse(const Matrix6d& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(symmetric);
  const double least = std::max(1e-12, 1e-6 * eigen.eigenvalues()[5]);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}
}  // namespace

Vector6d stepOfMetres()
{
  Vector6d scale;
  scale << 1, 1, 1, 1 / kArm, 1 / kArm, 1 / kArm;
  return scale;
}

LidarInformation lidarInformation(const Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Evidence evidence = inSource(evidenceOf(all, target_T_source, d2), target_T_source);
  const Matrix6d inverse = safeInverse(evidence.curvature);
  Matrix6d metres = inverse * evidence.noise * inverse;
  metres.diagonal().head<3>().array() += kTranslationFloor * kTranslationFloor;
  metres.diagonal().tail<3>().array() += kRotationFloor * kRotationFloor;

  LidarInformation information;
  information.degenerate = degenerateDirections(evidence);
  for (const Vector6d& direction : information.degenerate)
    metres += kUnknownDeviation * kUnknownDeviation * direction * direction.transpose();
  const Matrix6d symmetric = (metres + metres.transpose()) / 2;
  information.covariance = stepOfMetres().asDiagonal() * symmetric * stepOfMetres().asDiagonal();
  return information;
}
}  // namespace scanloom
