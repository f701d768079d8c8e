#include "lab/evaluation/Drift.h"

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kStep = 0.5;         // m
constexpr double kFittedShare = 0.1;  // of the path

/** Of each sample the path length of the reference up to the start of its step. */
std::vector<double> distancesOf(const std::vector<PositionPair>& pairs)
{
  std::vector<double> distances;
  Eigen::Vector3d vertex = pairs.front().reference_p;
  double distance = 0;
  for (const PositionPair& pair : pairs)
  {
    const double step = (pair.reference_p - vertex).norm();
    if (step >= kStep)
    {
      distance += step;
      vertex = pair.reference_p;
    }
    distances.push_back(distance);
  }
  return distances;
}

std::vector<PositionPair> upTo(double distance, const std::vector<PositionPair>& pairs,
                               const std::vector<double>& distances)
{
  const auto end = std::upper_bound(distances.begin(), distances.end(), distance);
  return {pairs.begin(), pairs.begin() + (end - distances.begin())};
}
}  // namespace

std::optional<double> Drift::percent() const
{
  if (path_length == 0) return std::nullopt;
  return 100 * largest / path_length;
}

Drift driftOf(const std::vector<PositionPair>& pairs, AlignmentKind kind)
{
  if (pairs.empty()) throw std::invalid_argument("driftOf: no pairs of positions");
  const std::vector<double> distances = distancesOf(pairs);
  const std::vector<PositionPair> start = upTo(kFittedShare * distances.back(), pairs, distances);

  Drift drift;
  drift.path_length = distances.back();
  drift.samples = pairs.size();
  drift.fitted = start.size();
  drift.alignment = align(start, kind);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto& [stamp, map_p, reference_p] = pairs[i];
    drift.final = (drift.alignment.reference_T_map * map_p - reference_p).norm();
    if (drift.final > drift.largest)
    {
      drift.largest = drift.final;
      drift.largest_at = stamp;
    }
    auto& over = drift.over_distance;
    if (over.empty() || over.back().distance < distances[i]) over.push_back({distances[i], 0});
    over.back().error = std::max(over.back().error, drift.final);
  }
  return drift;
}
}  // namespace scanloom
