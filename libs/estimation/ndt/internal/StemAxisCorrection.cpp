#include "estimation/ndt/internal/StemAxisCorrection.h"

#include "base/core/forAll.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/internal/EigenLanes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
/** A cheap test that all thin bodies pass, and few others. */
bool mayBeThin(const Eigen::Matrix3d& c)
{
  const double slim = fitted::kStemSlimness * fitted::kStemSlimness;
  const double minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) - c(0, 2) * c(0, 2) +
                        c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const double sum = c.trace();
  return minors * (slim + 2) * (slim + 2) <= sum * sum * (2 * slim + 1);  // equal where both widths are the largest
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
  const double opaque = 1.36;  // pi / 4 sqrt(3)
  const double porous = std::max(0.0, along_view - fitted::kRangeNoise * fitted::kRangeNoise) / sideways;
  return std::clamp(fitted::kDepthSlope * (1 - porous), 0.0, opaque) * std::sqrt(sideways);
}

/** Nothing for a body that is too thick, or seen along its axis. */
std::optional<ThinBody> thinBodyOf(const MeanAndCovariance& seen, const EigenBlock& eigen, std::size_t lane,
                                   const Sight& from)
{
  const Eigen::Vector3d variances = eigen.valuesOf(lane);
  Eigen::Index longest = 0;
  const double most = variances.maxCoeff(&longest);
  const double second = std::max(variances[(longest + 1) % 3], variances[(longest + 2) % 3]);
  const Eigen::Vector3d axis = eigen.vectorOf(static_cast<std::size_t>(longest), lane);
  const double range = (seen.mean - from.viewpoint).norm();
  const Eigen::Vector3d sight = (seen.mean - from.viewpoint) / range;
  const Eigen::Vector3d across = sight - sight.dot(axis) * axis;
  if (!(most > fitted::kStemSlimness * fitted::kStemSlimness * second && across.norm() > fitted::kStemAcrossSight))
    return std::nullopt;
  const Eigen::Vector3d towards = across.normalized(), sideways = axis.cross(towards);
  const double variance = sideways.dot(seen.covariance * sideways);
  if (3 * variance > fitted::kStemRadius * fitted::kStemRadius) return std::nullopt;
  return ThinBody{depthOfAxis(variance, towards.dot(seen.covariance * towards)) * towards, range,
                  std::abs(axis.dot(from.up)) > fitted::kStemUprightness};
}

using Bodies = std::vector<std::optional<ThinBody>>;

/** A cell that may hold a thin body. */
struct Candidate
{
  std::size_t bin;
  MeanAndCovariance seen;
};

/** Those among the bins from `begin` to `end`. */
std::vector<Candidate> candidatesAmong(const std::vector<Bin>& bins, std::size_t begin, std::size_t end,
                                       const Sight& sight)
{
  std::vector<Candidate> candidates;
  for (std::size_t i = begin; i < end; ++i)
  {
    if (bins[i].moments.n < sight.least_points) continue;
    const MeanAndCovariance seen = meanAndCovariance(bins[i], sight.edge);
    if (mayBeThin(seen.covariance)) candidates.push_back({i, seen});
  }
  return candidates;
}

/** A body, or none, for each bin. */
Bodies thinBodiesOf(const std::vector<Bin>& bins, const Sight& sight)
{
  const std::size_t in_part = 128;  // bins, about 20 us
  Bodies bodies(bins.size());
  forAll((bins.size() + in_part - 1) / in_part, 1,
         [&](std::size_t part)
         {
           const std::vector<Candidate> candidates =
               candidatesAmong(bins, part * in_part, std::min((part + 1) * in_part, bins.size()), sight);
           for (std::size_t first = 0; first < candidates.size(); first += SymmetricBlock::kLanes)
           {
             const std::size_t count = std::min(SymmetricBlock::kLanes, candidates.size() - first);
             SymmetricBlock covariances{};
             for (std::size_t i = 0; i < count; ++i) covariances.set(i, candidates[first + i].seen.covariance);
             const EigenBlock eigen = eigensystemsOf(covariances);
             for (std::size_t i = 0; i < count; ++i)
               bodies[candidates[first + i].bin] = thinBodyOf(candidates[first + i].seen, eigen, i, sight);
           }
         });
  return bodies;
}

/** The mean depth of the axes of stems nearby (m), as if ten stems with the assumed depth were among them. */
double typicalDepth(const Bodies& bodies, const std::vector<Bin>& bins, const Sight& sight)
{
  double sum = fitted::kAssumedStems * fitted::kAssumedDepth, stems = fitted::kAssumedStems;
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    if (!bodies[i] || !bodies[i]->stands || bodies[i]->range > fitted::kStemRange ||
        bins[i].moments.n < 2 * sight.least_points)
      continue;
    sum += bodies[i]->to_axis.norm();
    ++stems;
  }
  return sum / stems;
}

/** Unit vector from the viewpoint to the points, without its part along `up`. */
Eigen::Vector3d levelView(const Bin& bin, const Sight& sight)
{
  const Eigen::Vector3d view = meanOf(bin, sight.edge) - sight.viewpoint;
  return (view - view.dot(sight.up) * sight.up).normalized();
}
}  // namespace

std::vector<Bin> correctNearSideBias(std::vector<Bin> bins, const Sight& sight)
{
  const Bodies bodies = thinBodiesOf(bins, sight);
  const double typical = typicalDepth(bodies, bins, sight);
  forAll(bins.size(), 128,
         [&](std::size_t i)
         {
           if (bodies[i])
             bins[i] = moved(bins[i], bodies[i]->to_axis);
           else if (bins[i].moments.n < sight.least_points)
             bins[i] = moved(bins[i], typical * levelView(bins[i], sight));
         });
  return bins;
}
}  // namespace scanloom
