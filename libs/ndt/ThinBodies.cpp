#include "ndt/ThinBodies.h"

#include "core/Statistics.h"
#include "core/forAll.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
constexpr double kMeanBeforeAxis = M_PI / 4;  // radii, from the mean to the axis
constexpr double kSlimness = 2;               // length over width, as standard deviations
constexpr double kMostRadius = 0.3;           // m
constexpr double kLeastAcross = 0.3;          // of the line of sight's unit vector, across the axis
constexpr double kSteep = 0.8;                // vertical part of the axis of a stem
constexpr double kNear = 8;                   // m: several columns of most lidars hit a stem of 20 cm

/** A cheap test that all thin bodies pass, and few others. */
bool mayBeThin(const Eigen::Matrix3d& c)
{
  constexpr double kSlim = kSlimness * kSlimness;
  const double minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) - c(0, 2) * c(0, 2) +
                        c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const double sum = c.trace();
  return minors * (kSlim + 2) * (kSlim + 2) <= sum * sum * (2 * kSlim + 1);  // equal where both widths are the largest
}

/** A thin body in a cell, as a lidar sees it. */
struct ThinBody
{
  double radius = 0;        // m, by the points; too small if few rays hit it side by side
  Eigen::Vector3d towards;  // unit vector from its near side to its axis
  double range = 0;         // m
  bool stands = false;      // its axis is steep
};

/** Nothing for a body that is too thick, or seen along its axis. */
std::optional<ThinBody> thinBodyOf(const MeanAndCovariance& seen, const Eigen::Vector3d& viewpoint)
{
  if (!mayBeThin(seen.covariance)) return std::nullopt;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(seen.covariance);
  const Eigen::Vector3d& variances = eigen.eigenvalues();
  const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
  const double range = (seen.mean - viewpoint).norm();
  const Eigen::Vector3d sight = (seen.mean - viewpoint) / range;
  const Eigen::Vector3d across = sight - sight.dot(axis) * axis;
  if (!(variances[2] > kSlimness * kSlimness * variances[1] && across.norm() > kLeastAcross)) return std::nullopt;
  const Eigen::Vector3d towards = across.normalized(), sideways = axis.cross(towards);
  const double radius = std::sqrt(3 * std::max(0.0, sideways.dot(seen.covariance * sideways)));
  if (radius > kMostRadius) return std::nullopt;
  return ThinBody{radius, towards, range, std::abs(axis.z()) > kSteep};
}

/** Zero if too few bodies are near enough to be measured. */
double typicalRadius(const std::vector<std::optional<ThinBody>>& bodies, const std::vector<Bin>& bins, int least_points)
{
  constexpr std::size_t kFewest = 5;
  std::vector<double> radii;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i] && bodies[i]->range < kNear && bins[i].moments.n >= 2 * least_points)
      radii.push_back(bodies[i]->radius);
  return radii.size() < kFewest ? 0 : median(radii);
}
}  // namespace

void moveToAxes(std::vector<Bin>& bins, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint, int least_points)
{
  constexpr std::size_t kGrain = 128;
  constexpr std::int64_t kFewest = 2;  // show the direction of an axis
  const double edge = static_cast<double>(cell_quanta) * Moments::kQuantum;
  std::vector<std::optional<ThinBody>> bodies(bins.size());
  forAll(bins.size(), kGrain,
         [&](std::size_t i)
         {
           if (bins[i].moments.n < kFewest) return;
           bodies[i] = thinBodyOf(meanAndCovariance(bins[i], edge), viewpoint);
         });
  const double typical = typicalRadius(bodies, bins, least_points);
  forAll(bins.size(), kGrain,
         [&](std::size_t i)
         {
           const bool is_measured = bins[i].moments.n >= least_points;
           if (!bodies[i] || (!is_measured && !bodies[i]->stands)) return;
           const double radius = is_measured ? bodies[i]->radius : typical;
           moveBy(kMeanBeforeAxis * radius * bodies[i]->towards, bins[i]);
         });
}
}  // namespace scanloom
