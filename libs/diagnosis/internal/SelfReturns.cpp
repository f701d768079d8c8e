#include "diagnosis/internal/SelfReturns.h"

#include "base/core/VoxelKey.h"
#include "calibration/OwnParts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace scanloom
{
namespace
{
constexpr double kFarCube = 1;       // m: beams far apart hit a stem or a wall at other heights in every turn
constexpr double kLongestBoom = 12;  // m from the body's origin: longer than a harvester's boom
constexpr std::size_t kPlacesNeeded = 4;
constexpr double kMostStanding = 0.8;  // share of the points above the ground; a machine has fewer
constexpr double kFarAbove = 2;        // m above the ground: its rings stay at their distance on a drive, too
constexpr double kFewestFar = 50;      // points in a turn, to tell by them
constexpr double kSamePlace = 0.5;     // of what is far
constexpr double kMuch = 0.05;         // of the points on the machine: less is hardly seen in a map

std::vector<std::uint64_t> farCubes(const PointCloud& points, const std::optional<GroundPlane>& ground)
{
  std::vector<std::uint64_t> cubes;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f p = points.position(i);
    if (p.norm() > kLongestBoom && (!ground || ground->heightOf(p.cast<double>()) > kFarAbove))
      cubes.push_back(voxelKey(p, kFarCube));
  }
  return cubes;
}

/** Turns that were seen from different places; of turns that see hardly anything far away all. */
std::vector<std::size_t> differentPlaces(const std::vector<std::vector<std::uint64_t>>& far)
{
  std::vector<std::size_t> places;
  std::vector<std::unordered_set<std::uint64_t>> seen;
  for (std::size_t k = 0; k < far.size(); ++k)
  {
    const auto inPlace = [&](const std::unordered_set<std::uint64_t>& there)
    {
      const auto same =
          std::count_if(far[k].begin(), far[k].end(), [&](std::uint64_t cube) { return there.count(cube) > 0; });
      return static_cast<double>(same) > kSamePlace * static_cast<double>(far[k].size());
    };
    if (std::any_of(seen.begin(), seen.end(), inPlace)) continue;
    places.push_back(k);
    seen.emplace_back(far[k].begin(), far[k].end());
  }
  return places;
}

/** Between these quantiles along each axis: single points do not stretch the box. */
Eigen::AlignedBox3d boxAround(std::vector<Eigen::Vector3f> points)
{
  constexpr double kOutliers = 0.002, kMargin = 0.2;  // m: edges that are not always hit
  Eigen::AlignedBox3d box;
  if (points.empty()) return box;
  const auto skipped = static_cast<std::size_t>(kOutliers * static_cast<double>(points.size()));
  for (int axis = 0; axis < 3; ++axis)
  {
    std::sort(points.begin(), points.end(), [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    box.min()[axis] = points[skipped][axis] - kMargin;
    box.max()[axis] = points[points.size() - 1 - skipped][axis] + kMargin;
  }
  return box;
}
}  // namespace

SelfReturns selfReturns(const std::vector<const PointCloud*>& turns, const std::optional<GroundPlane>& ground,
                        const Crop& crop)
{
  std::vector<std::vector<std::uint64_t>> far;
  double all_far = 0;
  for (const PointCloud* turn : turns)
    far.push_back(farCubes(*turn, ground)), all_far += static_cast<double>(far.back().size());
  const bool far_tells = all_far > kFewestFar * static_cast<double>(turns.size());
  if (!far_tells) far.assign(turns.size(), {});
  const std::vector<std::size_t> places = differentPlaces(far);
  if (places.size() < kPlacesNeeded) return {};
  OwnParts machine(ground, kLongestBoom);
  for (const std::size_t k : places) machine.addPlace(*turns[k]);

  SelfReturns parts;
  double own = 0, standing = 0, all = 0, uncropped = 0;
  std::vector<Eigen::Vector3f> always;  // a bush is at most places by chance, but hardly at all
  for (const PointCloud* turn : turns)
  {
    parts.marks.emplace_back(turn->size(), 0);
    all += static_cast<double>(turn->size());
    for (std::size_t i = 0; i < turn->size(); ++i)
    {
      const Eigen::Vector3f p = turn->position(i);
      if (!machine.mayHold(p)) continue;
      ++standing;
      if (!machine.holds(p)) continue;
      ++own;
      parts.marks.back()[i] = 1;
      if (machine.shareOfPlaces(p) < 1) continue;
      always.push_back(p);
      uncropped += removes(crop, *turn, i) ? 0 : 1;
    }
  }
  if (!far_tells && own > kMostStanding * standing) return {};
  parts.known = true;
  parts.share = all > 0 ? own / all : 0;
  parts.uncropped = all > 0 ? uncropped / all : 0;
  parts.box = boxAround(std::move(always));
  return parts;
}

SelfReturns together(const std::vector<SelfReturns>& lidars, const std::vector<std::size_t>& points)
{
  SelfReturns all;
  double sum = 0;
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    if (!lidars[i].known) continue;
    const auto weight = static_cast<double>(points[i]);
    all.known = true;
    all.share += weight * lidars[i].share;
    all.uncropped += weight * lidars[i].uncropped;
    all.box.extend(lidars[i].box);
    sum += weight;
  }
  all.share /= std::max(sum, 1.0);
  all.uncropped /= std::max(sum, 1.0);
  return all;
}

std::string cropKeys(const Eigen::AlignedBox3d& box, const char* separator)
{
  std::string keys;
  for (int axis = 0; axis < 3; ++axis)
    keys += fmt::format("{0}min_{1} = {2:.1f}{4}max_{1} = {3:.1f}", keys.empty() ? "" : separator, "xyz"[axis],
                        std::floor(10 * box.min()[axis]) / 10, std::ceil(10 * box.max()[axis]) / 10, separator);
  return keys;
}

Finding cropFinding(const SelfReturns& parts)
{
  if (!parts.known) return {"rig", "crop", Verdict::NotMeasured, "what is on the machine is only seen while it drives"};
  Finding finding{"rig", "crop", Verdict::Ok,
                  fmt::format("{:.1f} % of the points stay in place while the machine drives, and pass [crop]",
                              100 * parts.uncropped)};
  if (parts.uncropped < kMuch || parts.box.isEmpty()) return finding;
  finding.verdict = Verdict::Warning;
  finding.mend =
      fmt::format("if they are the machine, not a ceiling or walls along the way, keep them out of the map: [crop] {}",
                  cropKeys(parts.box, " "));
  return finding;
}
}  // namespace scanloom
