#include "estimation/ndt/internal/StemAxisCorrection.h"

#include "base/core/forAll.h"
#include "estimation/ndt/internal/EigenLanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
constexpr double kSlimness = 2;       // length over width, as standard deviations
constexpr double kMostRadius = 0.3;   // m
constexpr double kLeastAcross = 0.3;  // of the line of sight's unit vector, across the axis
constexpr double kSteep = 0.8;        // upward part of the axis of a stem
constexpr double kNear = 12;          // m: two columns or more of most lidars hit a stem of 20 cm
constexpr double kRangeNoise = 0.04;  // m, standard deviation, of weak returns

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
  Eigen::Vector3d to_axis;  // m, from the mean of its points
  double range = 0;         // m
  bool stands = false;      // its axis is steep
};

/** From the mean of a body's points to its axis (m), by their variances (m^2): see the header. */
double depthOfAxis(double sideways, double along_view)
{
  if (sideways <= 0) return 0;
  constexpr double kOpaque = 1.36, kSlope = 1.6;
  const double porous = std::max(0.0, along_view - kRangeNoise * kRangeNoise) / sideways;
  return std::clamp(kSlope * (1 - porous), 0.0, kOpaque) * std::sqrt(sideways);
}

/** Nothing for a body that is too thick, or seen along its axis. */
std::optional<ThinBody> thinBodyOf(const MeanAndCovariance& seen, const EigenBlock& eigen, std::size_t lane,
                                   const Eigen::Vector3d& viewpoint, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d variances = eigen.valuesOf(lane);
  Eigen::Index longest = 0;
  const double most = variances.maxCoeff(&longest);
  const double second = std::max(variances[(longest + 1) % 3], variances[(longest + 2) % 3]);
  const Eigen::Vector3d axis = eigen.vectorOf(static_cast<std::size_t>(longest), lane);
  const double range = (seen.mean - viewpoint).norm();
  const Eigen::Vector3d sight = (seen.mean - viewpoint) / range;
  const Eigen::Vector3d across = sight - sight.dot(axis) * axis;
  if (!(most > kSlimness * kSlimness * second && across.norm() > kLeastAcross)) return std::nullopt;
  const Eigen::Vector3d towards = across.normalized(), sideways = axis.cross(towards);
  const double variance = sideways.dot(seen.covariance * sideways);
  if (3 * variance > kMostRadius * kMostRadius) return std::nullopt;
  return ThinBody{depthOfAxis(variance, towards.dot(seen.covariance * towards)) * towards, range,
                  std::abs(axis.dot(up)) > kSteep};
}

using Bodies = std::vector<std::optional<ThinBody>>;

/** Cells that may hold a thin body, as many as are decomposed at a time. */
class Candidates
{
 public:
  Candidates(const Eigen::Vector3d& viewpoint, const Eigen::Vector3d& up, Bodies& bodies)
    : viewpoint_(viewpoint), up_(up), bodies_(bodies)
  {
  }

  void add(std::size_t bin, const MeanAndCovariance& seen)
  {
    bins_[count_] = bin, seen_[count_] = seen;
    put(seen.covariance, covariances_, count_);
    if (++count_ == SymmetricBlock::kLanes) finish();
  }

  void finish()
  {
    if (count_ == 0) return;
    EigenBlock eigen;
    eigensystemsOf(covariances_, eigen);
    for (std::size_t i = 0; i < count_; ++i) bodies_[bins_[i]] = thinBodyOf(seen_[i], eigen, i, viewpoint_, up_);
    count_ = 0;
  }

 private:
  const Eigen::Vector3d& viewpoint_;
  const Eigen::Vector3d& up_;
  Bodies& bodies_;
  std::size_t count_ = 0;
  std::array<std::size_t, SymmetricBlock::kLanes> bins_;
  std::array<MeanAndCovariance, SymmetricBlock::kLanes> seen_;
  SymmetricBlock covariances_{};
};

/** By bin. */
Bodies thinBodiesOf(const std::vector<Bin>& bins, double edge, const Eigen::Vector3d& viewpoint,
                    const Eigen::Vector3d& up, int least_points)
{
  constexpr std::size_t kPart = 128;  // bins, about 20 us
  Bodies bodies(bins.size());
  forAll((bins.size() + kPart - 1) / kPart, 1,
         [&](std::size_t part)
         {
           Candidates candidates(viewpoint, up, bodies);
           for (std::size_t i = part * kPart; i < std::min((part + 1) * kPart, bins.size()); ++i)
           {
             if (bins[i].moments.n < least_points) continue;
             const MeanAndCovariance seen = meanAndCovariance(bins[i], edge);
             if (mayBeThin(seen.covariance)) candidates.add(i, seen);
           }
           candidates.finish();
         });
  return bodies;
}

/** The mean depth of the axes of stems nearby (m), as if ten stems with the assumed depth were among them. */
double typicalDepth(const Bodies& bodies, const std::vector<Bin>& bins, int least_points)
{
  constexpr double kAssumed = 0.03;  // m
  constexpr double kAssumedStems = 10;
  double sum = kAssumedStems * kAssumed, stems = kAssumedStems;
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    if (!bodies[i] || !bodies[i]->stands || bodies[i]->range > kNear || bins[i].moments.n < 2 * least_points) continue;
    sum += bodies[i]->to_axis.norm();
    ++stems;
  }
  return sum / stems;
}

/** Unit vector from the viewpoint to the points, without its part along `up`. */
Eigen::Vector3d levelView(const Bin& bin, double edge, const Eigen::Vector3d& viewpoint, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d view = meanOf(bin, edge) - viewpoint;
  return (view - view.dot(up) * up).normalized();
}
}  // namespace

void correctNearSideBias(std::vector<Bin>& bins, std::int64_t cell_quanta, const Eigen::Vector3d& viewpoint,
                         const Eigen::Vector3d& up, int least_points)
{
  constexpr std::size_t kGrain = 128;
  const double edge = edgeOf(cell_quanta);
  const Bodies bodies = thinBodiesOf(bins, edge, viewpoint, up, least_points);
  const double typical = typicalDepth(bodies, bins, least_points);
  forAll(bins.size(), kGrain,
         [&](std::size_t i)
         {
           if (bodies[i])
             moveBy(bodies[i]->to_axis, bins[i]);
           else if (bins[i].moments.n < least_points)
             moveBy(typical * levelView(bins[i], edge, viewpoint, up), bins[i]);
         });
}
}  // namespace scanloom
