#include "mrpt/maps/OctoMapEstimate.h"

#include "mrpt/maps/SimpleMapReader.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Measured with two OS0-128 in simulated stands (tests/benchmarks/output_benchmark.cpp).
constexpr double kSeenHeight = 0.6;          // of max_range: rays end at the ground and leave the stand above
constexpr double kInnerNodes = 8.0 / 7;      // per leaf
constexpr double kBytesPerNode = 56;         // with its share of the array of children
constexpr double kSecondsPerVoxel = 2.5e-7;  // that a lidar's rays touch; with writing the files

double diskVolume(double range) { return M_PI * range * range * kSeenHeight * range; }

double lengthOf(const Trajectory& poses)
{
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].map_T_body.translation - poses[i - 1].map_T_body.translation).norm();
  return length;
}
}  // namespace

DriveSize driveSizeOf(const SimpleMapReader& reader)
{
  DriveSize drive{std::vector<double>(reader.lidars().size(), 0.0), static_cast<double>(reader.size())};
  Trajectory path;
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    const Keyframe keyframe = reader.keyframe(i);
    path.push_back({keyframe.stamp, keyframe.map_T_body});
    for (const std::uint8_t id : keyframe.points.sensor_id) drive.rays[id] += 1.0 / drive.keyframes;
  }
  drive.length = lengthOf(path);
  return drive;
}

DriveSize driveSizeOf(const Trajectory& path, double keyframe_distance, const RecordingHeader& header)
{
  DriveSize drive;
  for (const RecordedLidar& lidar : header.lidars) drive.rays.push_back(1.0 * lidar.beams * lidar.columns);
  drive.length = lengthOf(path);
  drive.keyframes =
      keyframe_distance > 0 ? std::floor(drive.length / keyframe_distance) + 1 : static_cast<double>(path.size());
  return drive;
}

OctoMapCost estimateOf(const OctoMapOptions& options, const DriveSize& drive)
{
  const double voxel = std::pow(options.resolution, 3);
  double touched = 0;  // per keyframe
  for (const double rays : drive.rays)
    touched += std::min(rays * options.max_range / options.resolution, 0.5 * diskVolume(options.max_range) / voxel);

  const double swept =
      diskVolume(options.max_range) + 2 * options.max_range * kSeenHeight * options.max_range * drive.length;
  const double leaves = std::min(swept / voxel, touched * drive.keyframes);
  return {touched * drive.keyframes * kSecondsPerVoxel, leaves * kInnerNodes * kBytesPerNode};
}
}  // namespace scanloom
