#include "diagnosis/internal/LidarCheck.h"

#include "base/core/Angle.h"
#include "base/core/VoxelKey.h"
#include "diagnosis/internal/GroundFinding.h"
#include "diagnosis/internal/SelfReturns.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace scanloom
{
namespace
{
constexpr std::size_t kFewest = 3, kMost = 8;  // keyframes: deviations come from leaving out one of them
constexpr std::size_t kNeighbours = 2;         // keyframes to each side of one
// Of a keyframe or scan: memory is bounded. With half as many, a pose on a bare field is known to 0.25 deg only.
constexpr std::size_t kPointsOfLidar = 1 << 15;
constexpr double kOfOneGround = 25 * kDegree;  // between the normals that two lidars see, slopes on both sides included

/** By lidar, whole columns, so that the distance between beams stays what it is. */
std::vector<PointCloud> splitByLidar(const PointCloud& points, std::size_t lidars)
{
  std::vector<std::size_t> counts(lidars, 0);
  for (const std::uint8_t lidar : points.sensor_id)
    if (lidar < lidars) ++counts[lidar];
  std::vector<PointCloud> seen(lidars);
  for (std::size_t lidar = 0; lidar < lidars; ++lidar)
  {
    const std::size_t every_nth = 1 + counts[lidar] / kPointsOfLidar;
    std::vector<std::uint8_t> keep(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      keep[i] = points.sensor_id[i] == lidar && points.column[i] % every_nth == 0 ? 1 : 0;
    seen[lidar] = points;
    seen[lidar].keep(keep);
  }
  return seen;
}
/** In another frame. */
PointCloud moved(PointCloud points, const Rigid& here_T_there)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f p = (here_T_there * points.position(i).cast<double>()).cast<float>();
    points.x[i] = p.x();
    points.y[i] = p.y();
    points.z[i] = p.z();
  }
  return points;
}

/** The cube in which each point lies, in the frame of the points. */
std::vector<std::uint64_t> cubesOf(const PointCloud& points)
{
  constexpr float kCube = 1;  // m: far away beams are so far apart
  std::vector<std::uint64_t> cubes;
  for (std::size_t i = 0; i < points.size(); ++i) cubes.push_back(voxelKey(points.position(i), kCube));
  return cubes;
}

std::vector<SeenByBoth> pairsOf(const std::vector<SeenPoints>& a, const std::vector<SeenPoints>& b)
{
  std::vector<SeenByBoth> pairs;
  for (std::size_t k = 0; k < a.size(); ++k) pairs.push_back({&a[k], &b[k]});
  return pairs;
}
}  // namespace

void LidarCheck::add(const Keyframe& keyframe)
{
  if (keyframes_.size() == kMost) keyframes_.erase(keyframes_.begin());
  keyframes_.push_back(
      std::make_shared<const Seen>(Seen{keyframe.map_T_body, splitByLidar(keyframe.points, lidars_.size())}));
}

void LidarCheck::add(const Scan& scan)
{
  if (scan.points.empty()) return;
  if (auto* const selected = scans_.at(scans_seen_++))
    *selected = std::make_shared<const PointsByLidar>(splitByLidar(scan.points, lidars_.size()));
}

std::vector<SeenPoints> LidarCheck::seenBy(std::size_t lidar) const
{
  std::vector<SeenPoints> seen;
  for (const auto& keyframe : keyframes_) seen.push_back({keyframe->points[lidar], {}});
  return seen;
}

std::vector<SeenPoints> LidarCheck::seenAround(std::size_t lidar, bool with_itself) const
{
  std::vector<SeenPoints> seen(keyframes_.size());
  for (std::size_t k = 0; k < keyframes_.size(); ++k)
    for (std::size_t i = k - std::min(kNeighbours, k); i <= std::min(k + kNeighbours, keyframes_.size() - 1); ++i)
    {
      if (i == k && !with_itself) continue;
      const Rigid here_T_there = keyframes_[k]->map_T_body.inverse() * keyframes_[i]->map_T_body;
      seen[k].points.append(moved(keyframes_[i]->points[lidar], here_T_there));
    }
  return seen;
}

std::vector<const PointCloud*> LidarCheck::cloudsOf(std::size_t lidar) const
{
  std::vector<const PointCloud*> clouds;
  for (const auto& keyframe : keyframes_) clouds.push_back(&keyframe->points[lidar]);
  return clouds;
}

std::optional<GroundPlane> LidarCheck::groundOf(std::size_t lidar) const
{
  return groundPlane(cloudsOf(lidar), lidars_[lidar].body_T_sensor.translation);
}

/**
 * Whether what looks like the machine at a keyframe is seen there from others, too, when the machine is elsewhere: the
 * walls of a corridor and the ceiling of a car park stay in place in the body frame as well. `size`: m, of the machine.
 */
bool LidarCheck::staysBehind(const std::vector<SelfReturns>& parts, double size) const
{
  constexpr double kShare = 0.3;                        // 0.1 at most of a machine; half and more of walls and ceilings
  std::vector<std::unordered_set<std::uint64_t>> seen;  // by keyframe
  for (const auto& keyframe : keyframes_)
  {
    seen.emplace_back();
    for (const PointCloud& points : keyframe->points)
      for (const std::uint64_t cube : cubesOf(moved(points, keyframe->map_T_body))) seen.back().insert(cube);
  }
  std::size_t asked = 0, found = 0;
  const auto lookFor = [&](std::uint64_t cube, const std::vector<std::size_t>& elsewhere)
  {
    ++asked;
    found += std::any_of(elsewhere.begin(), elsewhere.end(), [&](std::size_t i) { return seen[i].count(cube) > 0; });
  };
  for (std::size_t k = 0; k < keyframes_.size(); ++k)
  {
    const Seen& here = *keyframes_[k];
    std::vector<std::size_t> elsewhere;
    for (std::size_t i = 0; i < keyframes_.size(); ++i)
      if ((keyframes_[i]->map_T_body.translation - here.map_T_body.translation).norm() >= size) elsewhere.push_back(i);
    if (elsewhere.empty()) continue;
    for (std::size_t lidar = 0; lidar < parts.size(); ++lidar)
    {
      if (!parts[lidar].known) continue;
      const std::vector<std::uint64_t> cubes = cubesOf(moved(here.points[lidar], here.map_T_body));
      for (std::size_t n = 0; n < cubes.size(); ++n)
        if (parts[lidar].marks[k][n] != 0) lookFor(cubes[n], elsewhere);
    }
  }
  return static_cast<double>(found) > kShare * static_cast<double>(asked);
}

Finding LidarCheck::crop() const
{
  std::vector<SelfReturns> parts;
  std::vector<std::size_t> points(lidars_.size(), 0);
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    parts.push_back(selfReturns(cloudsOf(i), groundOf(i)));
    for (const PointCloud* cloud : cloudsOf(i)) points[i] += cloud->size();
  }
  const SelfReturns all = together(parts, points);
  return cropFinding(staysBehind(parts, all.box.diagonal().norm()) ? SelfReturns{} : all);
}

Findings LidarCheck::compareGrounds() const
{
  Findings tilted;
  bool contradict = false;
  std::vector<Eigen::Vector3d> ups;  // of the lidars that see the ground, by what the poses say
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    const std::optional<GroundPlane> plane = groundOf(i);
    if (!plane) continue;
    for (const Eigen::Vector3d& up : ups) contradict |= up.dot(plane->up) < std::cos(kOfOneGround);
    ups.push_back(plane->up);
    Finding ground = groundFinding(lidars_[i], plane);
    if (ground.verdict >= Verdict::Warning) tilted.push_back(std::move(ground));
  }
  return contradict ? tilted : Findings{};
}

std::vector<SeenPoints> LidarCheck::seenInScans(std::size_t lidar) const
{
  const std::vector<std::shared_ptr<const PointsByLidar>> scans = EvenSelection(scans_).taken();
  std::vector<const PointCloud*> clouds;
  for (const auto& scan : scans) clouds.push_back(&(*scan)[lidar]);
  const SelfReturns own = selfReturns(clouds, groundPlane(clouds, lidars_[lidar].body_T_sensor.translation));
  std::vector<SeenPoints> seen;
  for (std::size_t k = 0; k < clouds.size(); ++k)
    seen.push_back({*clouds[k], own.known ? own.marks[k] : std::vector<std::uint8_t>{}});
  return seen;
}

Finding LidarCheck::poseBy(std::size_t lidar, const std::vector<SeenPoints>& own,
                           const std::vector<SeenPoints>& by_first) const
{
  return poseFinding(lidars_[lidar].name, lidars_[0].name,
                     cloudAgreement(pairsOf(own, by_first), lidars_[lidar].body_T_sensor, lidars_[0].body_T_sensor));
}

Findings LidarCheck::posesByScans() const
{
  Findings poses;
  const std::vector<SeenPoints> by_first = seenInScans(0);
  for (std::size_t i = 1; i < lidars_.size(); ++i) poses.push_back(poseBy(i, seenInScans(i), by_first));
  return poses;
}

Findings LidarCheck::compareBeforeKeyframes() const
{
  Findings tilted = compareGrounds();
  return tilted.empty() && scans_seen_ > 0 ? posesByScans() : tilted;
}

Findings LidarCheck::compare() const
{
  if (keyframes_.size() < kFewest) return compareBeforeKeyframes();
  Findings findings;
  const std::vector<SeenPoints> by_first = seenAround(0, true);
  // Single scans see less than keyframes with their neighbours: along a street they fit 0.2 m off.
  const Findings by_scans = keyframes_.size() < kMost ? posesByScans() : Findings{};
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    const auto& [name, body_T_sensor] = lidars_[i];
    const std::vector<SeenPoints> own = seenBy(i), on_the_way = seenAround(i, false);
    findings.push_back(steadinessFinding(name, sharedView(pairsOf(own, on_the_way), Rigid::identity(), body_T_sensor)));
    if (i == 0 || findings.front().verdict > Verdict::Ok) continue;  // the first lidar is no measure of the others
    Finding pose = poseBy(i, own, by_first);
    if (!by_scans.empty() && by_scans[i - 1].verdict > pose.verdict) pose = by_scans[i - 1];
    findings.push_back(std::move(pose));
  }
  return findings;
}
}  // namespace scanloom
