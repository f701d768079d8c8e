#include "calibration/internal/LidarScans.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostPoints = 1 << 14, kMostScans = 600;  // of a lidar

LidarScan scanOf(std::uint8_t lidar, const Rigid& sensor_T_body, const Scan& scan)
{
  std::size_t points = 0;
  for (const Column& column : scan.columns) points += column.sensor_id == lidar ? column.count : 0;
  const std::size_t every_nth = 1 + points / kMostPoints;

  LidarScan seen{scan.start, scan.period, {}, {}};
  std::size_t columns = 0;
  for (const Column& column : scan.columns)
  {
    if (column.sensor_id != lidar || columns++ % every_nth != 0) continue;
    for (std::size_t i = column.first_point; i < column.first_point + column.count; ++i)
    {
      seen.points.push_back((sensor_T_body * scan.points.position(i).cast<double>()).cast<float>());
      seen.t.push_back(scan.points.t[i]);
    }
  }
  return seen;
}

void keepEverySecond(std::vector<LidarScan>& scans)
{
  for (std::size_t i = 0; 2 * i < scans.size(); ++i) std::swap(scans[i], scans[2 * i]);
  scans.resize((scans.size() + 1) / 2);
}
}  // namespace

LidarScans::LidarScans(std::vector<MountedLidar> lidars) : lidars_(std::move(lidars)), scans_(lidars_.size()) {}

void LidarScans::add(const Scan& scan)
{
  if (seen_++ % every_nth_ != 0) return;
  for (std::size_t lidar = 0; lidar < lidars_.size(); ++lidar)
  {
    LidarScan seen = scanOf(static_cast<std::uint8_t>(lidar), lidars_[lidar].body_T_sensor.inverse(), scan);
    if (!seen.points.empty()) scans_[lidar].push_back(std::move(seen));
  }
  const bool full = std::any_of(scans_.begin(), scans_.end(), [](const auto& of) { return of.size() > kMostScans; });
  if (!full) return;
  every_nth_ *= 2;
  for (std::vector<LidarScan>& of_lidar : scans_) keepEverySecond(of_lidar);
}
}  // namespace scanloom
