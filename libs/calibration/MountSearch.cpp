#include "calibration/MountSearch.h"

#include "base/core/Angle.h"
#include "calibration/GroundPlane.h"
#include "calibration/internal/MountEquations.h"
#include "calibration/internal/StationMaps.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::size_t kCompared = 8;      // stations
constexpr std::size_t kScansAtStart = 4;  // of a station
constexpr MountLevel kWideLevel{4.0, 0.05, kScansAtStart}, kNarrowLevel{2.0, 0.5, kScansAtStart},
    kFineLevel{1.0, 0.4, kScansAtStart};

/** Without ground and crowns in thick cells, which fit nearly as well the wrong way round. */
constexpr MountLevel scoredLevel()
{
  MountLevel level = kFinestLevel;
  level.scans = kScansAtStart;
  return level;
}

std::vector<Station> someOf(const std::vector<Station>& all, std::size_t count)
{
  std::vector<Station> some;
  for (std::size_t i = 0; i < std::min(count, all.size()); ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

/** At some stations. */
class LevelOfSearch
{
 public:
  LevelOfSearch(const MountLevel& level, const std::vector<Station>& stations, const Trajectory& trajectory)
    : level_(level), stations_(stations), trajectory_(trajectory), reference_(mapsOfReference(stations, level))
  {
  }

  Mount refined(Mount mount) const
  {
    const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    mount.body_T_sensor = minimiseMount(pairs, at_rest_, Clock::Kept, level_.d2).correction.pose * mount.body_T_sensor;
    return mount;
  }

  /** Points that are where the reference saw something. */
  double scoreOf(const Mount& mount) const
  {
    const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    return mountEquations(pairs, at_rest_, {}, level_.d2).met_points;
  }

 private:
  MountLevel level_;
  const std::vector<Station>& stations_;
  const Trajectory& trajectory_;
  std::vector<NdtMap> reference_;
  std::vector<Vector6d> at_rest_ = std::vector<Vector6d>(stations_.size(), Vector6d::Zero());
};

/**
 * Of the starts, as they are and refined, within `farthest` (m) of the guess: lidars that look apart have the more in
 * common the farther one is moved along the drive.
 */
Mount bestFrom(const std::vector<Mount>& starts, const Mount& guess, double farthest, const std::vector<Station>& all,
               const Trajectory& trajectory)
{
  const std::vector<Station> stations = someOf(all, kCompared);
  const LevelOfSearch wide(kWideLevel, stations, trajectory), narrow(kNarrowLevel, stations, trajectory),
      fine(kFineLevel, stations, trajectory), scored(scoredLevel(), stations, trajectory);
  Mount best = guess;
  double best_score = -1;
  for (const Mount& start : starts)
    for (const Mount& near : {start, narrow.refined(start), narrow.refined(wide.refined(start))})
    {
      const Mount candidate = fine.refined(fine.refined(near));
      const Eigen::Vector3d moved = candidate.body_T_sensor.translation - guess.body_T_sensor.translation;
      const double score = moved.norm() < farthest ? scored.scoreOf(candidate) : -1;
      if (score <= best_score) continue;
      best = candidate;
      best_score = score;
    }
  return best;
}

std::optional<GroundPlane> groundOf(const std::vector<LidarScan>& scans, const Rigid& body_T_sensor)
{
  constexpr std::size_t kScans = 10;
  std::vector<PointCloud> clouds;
  for (std::size_t i = 0; i < std::min(kScans, scans.size()); ++i)
  {
    const LidarScan& scan = scans[i * scans.size() / kScans % scans.size()];
    PointCloud cloud;
    cloud.resize(scan.points.size());
    for (std::size_t k = 0; k < scan.points.size(); ++k)
    {
      const Eigen::Vector3f p = (body_T_sensor * scan.points[k].cast<double>()).cast<float>();
      cloud.x[k] = p.x(), cloud.y[k] = p.y(), cloud.z[k] = p.z();
    }
    clouds.push_back(std::move(cloud));
  }
  std::vector<const PointCloud*> pointers;
  for (const PointCloud& cloud : clouds) pointers.push_back(&cloud);
  return groundPlane(pointers, body_T_sensor.translation);
}

/** Turned so that the lidar sees the ground in the plane in which the reference sees it; the same without a ground. */
Mount levelled(Mount mount, const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
               const Rigid& body_T_reference)
{
  const std::optional<GroundPlane> ours = groundOf(of_lidar, mount.body_T_sensor);
  const std::optional<GroundPlane> reference = groundOf(of_reference, body_T_reference);
  if (!ours || !reference) return mount;
  Rigid& pose = mount.body_T_sensor;
  pose.rotation = (rotationBetween(ours->up, reference->up) * pose.rotation).normalized();
  const double height = reference->up.dot(pose.translation) + reference->body_height;
  pose.translation += (ours->sensor_height - height) * reference->up;
  return mount;
}

/** The mount, and the same turned about the body's z by multiples of `step`. */
std::vector<Mount> headingsAround(const Mount& mount, int to_each_side, double step)
{
  std::vector<Mount> headings;
  for (int i = -to_each_side; i <= to_each_side; ++i)
  {
    Mount turned = mount;
    turned.body_T_sensor.rotation =
        Eigen::AngleAxisd(i * step, Eigen::Vector3d::UnitZ()) * mount.body_T_sensor.rotation;
    headings.push_back(turned);
  }
  return headings;
}
}  // namespace

Mount findStart(const std::vector<Station>& stations, const Mount& given, PoseGiven known,
                const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                const Rigid& body_T_reference, const Trajectory& trajectory)
{
  Mount start = given;
  if (known == PoseGiven::No) start.body_T_sensor = {Eigen::Quaterniond::Identity(), body_T_reference.translation};
  const Mount level = levelled(start, of_lidar, of_reference, body_T_reference);
  std::vector<Mount> starts =
      known == PoseGiven::No ? headingsAround(level, 6, 30 * kDegree) : headingsAround(level, 2, 10 * kDegree);
  starts.push_back(start);
  const double farthest = known == PoseGiven::No ? 5 : 0.7;  // m
  return bestFrom(starts, start, farthest, stations, trajectory);
}
}  // namespace scanloom
