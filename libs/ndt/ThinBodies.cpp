#include "ndt/ThinBodies.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kMeanBeforeAxis = M_PI / 4;  // radii, from the mean to the axis
constexpr double kSlimness = 2;               // length over width, as standard deviations
constexpr double kMostRadius = 0.3;           // m
constexpr double kLeastAcross = 0.3;          // of the line of sight's unit vector, across the axis

/** A cheap test that all thin bodies pass, and few others. */
bool mayBeThin(const Eigen::Matrix3d& c)
{
  constexpr double kSlim = kSlimness * kSlimness;
  const double minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) - c(0, 2) * c(0, 2) +
                        c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const double sum = c.trace();
  return minors * (kSlim + 2) * (kSlim + 2) <= sum * sum * (2 * kSlim + 1);  // equal where both widths are the largest
}

/** From the mean of the points to the axis, in m; zero if there is no thin body. */
Eigen::Vector3d vectorToAxis(const MeanAndCovariance& seen, const Eigen::Vector3d& viewpoint)
{
  if (!mayBeThin(seen.covariance)) return Eigen::Vector3d::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(seen.covariance);
  const Eigen::Vector3d& variances = eigen.eigenvalues();
  const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
  const Eigen::Vector3d sight = (seen.mean - viewpoint).normalized();
  const Eigen::Vector3d across = sight - sight.dot(axis) * axis;
  if (!(variances[2] > kSlimness * kSlimness * variances[1] && across.norm() > kLeastAcross))
    return Eigen::Vector3d::Zero();
  const Eigen::Vector3d towards = across.normalized(), sideways = axis.cross(towards);
  const double radius = std::sqrt(3 * std::max(0.0, sideways.dot(seen.covariance * sideways)));
  return radius <= kMostRadius ? Eigen::Vector3d(kMeanBeforeAxis * radius * towards) : Eigen::Vector3d::Zero();
}
}  // namespace

void moveToAxes(std::vector<Bin>& bins, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint, int least_points)
{
  constexpr std::size_t kGrain = 128;
  const double edge = static_cast<double>(cell_quanta) * Moments::kQuantum;
  const auto move = [&](Bin& bin)
  {
    if (bin.moments.n < least_points) return;
    const Eigen::Vector3d corner = edge * CellKey::indexOf(bin.key).cast<double>();
    const Eigen::Vector3d shift = vectorToAxis(meanAndCovariance(bin.moments, corner), viewpoint);
    bin.moments = bin.moments.about({quantaOf(shift.x()), quantaOf(shift.y()), quantaOf(shift.z())});
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bins.size(), kGrain),
                    [&](const auto& range)
                    {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) move(bins[i]);
                    });
}
}  // namespace scanloom
