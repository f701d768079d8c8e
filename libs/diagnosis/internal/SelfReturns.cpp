#include "diagnosis/internal/SelfReturns.h"

#include "base/core/VoxelKey.h"

#include <cmath>
#include <unordered_map>

namespace scanloom
{
namespace
{
constexpr double kPartCube = 0.25;      // m
constexpr double kFarCube = 1;          // m: beams far apart hit a stem or a wall at other heights in every turn
constexpr double kFarFromGround = 0.4;  // m
constexpr double kLongestBoom = 12;     // m from the body's origin: longer than a harvester's boom
constexpr double kAlmostAlways = 0.75;  // of the snapshots
constexpr std::size_t kFewestSnapshots = 4;
constexpr double kMost = 0.8;      // share of the points above the ground; a machine has fewer
constexpr double kFarAbove = 2;    // m above the ground: its rings stay at their distance on a drive, too
constexpr double kFewestFar = 50;  // points in a snapshot, to tell by them
constexpr double kStoodStill = 0.5;

/** Counts the snapshots in which each cube holds a point. The map is never iterated: its order is not defined. */
class Occupancy
{
 public:
  explicit Occupancy(double edge) : edge_(edge) {}

  void add(const PointCloud& points, int snapshot)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      Cube& cube = cubes_[voxelKey(points.position(i), edge_)];
      if (cube.last != snapshot) ++cube.snapshots;
      cube.last = snapshot;
    }
  }

  int snapshotsAt(const Eigen::Vector3f& p) const { return cubes_.at(voxelKey(p, edge_)).snapshots; }

 private:
  struct Cube
  {
    int snapshots = 0, last = -1;
  };
  double edge_;  // m
  std::unordered_map<std::uint64_t, Cube> cubes_;
};
}  // namespace

SelfReturns markSelfReturns(std::vector<RigSnapshot>& snapshots, std::size_t lidar,
                            const std::optional<GroundPlane>& ground)
{
  SelfReturns parts;
  if (snapshots.size() < kFewestSnapshots) return parts;
  Occupancy occupancy(kPartCube), coarse(kFarCube);
  for (std::size_t k = 0; k < snapshots.size(); ++k)
    for (Occupancy* cubes : {&occupancy, &coarse}) cubes->add(snapshots[k][lidar].points, static_cast<int>(k));

  const auto often = static_cast<int>(std::ceil(kAlmostAlways * static_cast<double>(snapshots.size())));
  const auto onGround = [&](const Eigen::Vector3f& p)
  { return ground && std::abs(ground->up.dot(p.cast<double>()) + ground->body_height) < kFarFromGround; };

  const auto isFar = [&](const Eigen::Vector3f& p) {
    return p.norm() > kLongestBoom && (!ground || ground->up.dot(p.cast<double>()) + ground->body_height > kFarAbove);
  };

  double own = 0, standing = 0, all = 0, far = 0, far_in_place = 0;
  std::vector<std::vector<std::uint8_t>> marks;
  for (const RigSnapshot& snapshot : snapshots)
  {
    const PointCloud& points = snapshot[lidar].points;
    marks.emplace_back(points.size(), 0);
    all += static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector3f p = points.position(i);
      if (isFar(p)) ++far;
      if (isFar(p) && coarse.snapshotsAt(p) >= often) ++far_in_place;
      if (p.norm() > kLongestBoom || onGround(p)) continue;
      ++standing;
      if (occupancy.snapshotsAt(p) < often) continue;
      ++own;
      marks.back()[i] = 1;
      parts.box.extend(p.cast<double>());
    }
  }
  const bool far_tells = far > kFewestFar * static_cast<double>(snapshots.size());
  if (far_tells ? far_in_place > kStoodStill * far : own > kMost * standing) return {};
  parts.known = true;
  parts.share = all > 0 ? own / all : 0;
  for (std::size_t k = 0; k < snapshots.size(); ++k) snapshots[k][lidar].own = std::move(marks[k]);
  return parts;
}
}  // namespace scanloom
