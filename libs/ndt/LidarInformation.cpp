#include "ndt/LidarInformation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;
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

/**
 * Takes away the directions in which points fill their cell. There a cell's mean tells where the grid lies, not where
 * the world does: a wall's cells resist sliding along the wall although nothing in the wall does.
 */
Matrix3d thinDirections(const GaussianCell& cell, double edge)
{
  const double filled = edge * edge / 12;  // variance of a uniform distribution
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
  eigen.computeDirect(cell.covariance);
  const Vector3d share = (1 - eigen.eigenvalues().array() / filled).max(0.0).sqrt();
  return eigen.eigenvectors() * share.asDiagonal() * eigen.eigenvectors().transpose();
}

/** What is gathered per target cell; most are met by several source cells, many by none. */
struct TargetRole
{
  Matrix63 pull = Matrix63::Zero();  // d gradient / d mean
  std::optional<Matrix3d> thin;
};

/** Sums over all pairs; steps in metres. */
struct Evidence
{
  Matrix6d resistance = Matrix6d::Zero();  // sum J' wB J
  Matrix6d structure = Matrix6d::Zero();   // the same of thin directions only
  Matrix6d curvature = Matrix6d::Zero();   // of the score with B held
  Matrix6d noise = Matrix6d::Zero();       // covariance of the gradient
};

Evidence evidenceOf(const Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  std::vector<TargetRole> roles(all.target().size());
  Evidence evidence;
  for (std::size_t i = 0; i < all.source().size(); ++i)
  {
    const GaussianCell& source = all.source()[i];
    const Vector3d mean = target_T_source * source.mean;
    const Matrix3d covariance = rotation * source.covariance * rotation.transpose();
    const Matrix3d thin_source = rotation * thinDirections(source, all.sourceEdge()) * rotation.transpose();
    Matrix36 jacobian;  // of m
    jacobian << rotation, -rotation * skew(source.mean);
    jacobian = jacobian * stepOfMetres().asDiagonal();

    Matrix3d weights = Matrix3d::Zero(), structures = Matrix3d::Zero(), pulls = Matrix3d::Zero();
    for (const std::uint32_t j : all.of(i))
    {
      const GaussianCell& target = all.target()[j];
      const Matrix3d b = (covariance + target.covariance).inverse();
      const Vector3d m = mean - target.mean;
      const Vector3d u = b * m;
      const double w = d2 * std::exp(-d2 / 2 * m.dot(u));
      const Matrix3d pull = w * (b - d2 * u * u.transpose());
      TargetRole& role = roles[j];
      if (!role.thin) role.thin = thinDirections(target, all.targetEdge());
      const Matrix3d thin = thin_source * *role.thin;
      weights += w * b;
      structures += w * thin * b * thin.transpose();
      pulls += pull;
      role.pull += jacobian.transpose() * pull;
    }
    const Matrix63 pull_of_source = jacobian.transpose() * pulls;
    evidence.resistance += jacobian.transpose() * weights * jacobian;
    evidence.structure += jacobian.transpose() * structures * jacobian;
    evidence.curvature += pull_of_source * jacobian;
    evidence.noise +=
        pull_of_source * rotation * covarianceOfMean(source) * rotation.transpose() * pull_of_source.transpose();
  }
  for (std::size_t j = 0; j < roles.size(); ++j)
    if (roles[j].thin) evidence.noise += roles[j].pull * covarianceOfMean(all.target()[j]) * roles[j].pull.transpose();
  return evidence;
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
  const Evidence evidence = evidenceOf(all, target_T_source, d2);
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
