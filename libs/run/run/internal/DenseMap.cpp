#include "run/run/internal/DenseMap.h"

#include "base/core/ConfigError.h"
#include "base/core/VoxelKey.h"
#include "run/run/internal/reasonOf.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostWaiting = 8;
}

std::string DenseMap::nameOf(const OutputOptions& options)
{
  const std::vector<std::string>& endings = CloudWriter::endings();
  if (std::find(endings.begin(), endings.end(), "." + options.dense_map) == endings.end())
    throw ConfigError(fmt::format("[output] dense_map = {}: must be las, laz, pcd or ply", options.dense_map));
  return "dense_map." + options.dense_map;
}

DenseMap::DenseMap(const std::filesystem::path& folder, const OutputOptions& options)
  : name_(nameOf(options)),
    voxel_(options.dense_voxel),
    writer_(folder / name_),
    queue_(kMostWaiting),
    written_(std::async(std::launch::async, [this] { write(); }))
{
}

DenseMap::~DenseMap() { queue_.end(); }

void DenseMap::add(const StateEstimate& estimate)
{
  if (estimate.health == Health::Lost || estimate.cloud.empty()) return;
  queue_.push({estimate.stamp, estimate.map_T_body, estimate.cloud});
}

void DenseMap::write()
{
  try
  {
    while (std::optional<Keyframe> scan = queue_.pop())
      times_.measure(
          "output.dense_map", [&]
          { writer_.add(firstInVoxels(std::move(scan->points), scan->map_T_body), scan->stamp, scan->map_T_body); });
  }
  catch (...)
  {
    queue_.close();  // the run goes on without this map
    throw;
  }
}

PointCloud DenseMap::firstInVoxels(PointCloud points, const Rigid& map_T_points)
{
  if (voxel_ == 0) return points;
  const Eigen::Isometry3d map_T(Eigen::Translation3d(map_T_points.translation) * map_T_points.rotation);
  std::vector<std::uint8_t> keep(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keep[i] = taken_.insert(voxelKey((map_T * points.position(i).cast<double>()).cast<float>().eval(), voxel_)).second;
  points.keep(keep);
  return points;
}

void DenseMap::close(RunSummary& summary)
{
  queue_.end();
  try
  {
    written_.get();
    times_.measure("output.dense_map", [&] { writer_.close(); });
    summary.counts["dense_map_points"] = writer_.size();
  }
  catch (const std::exception& error)
  {
    summary.error += fmt::format("{}without {}: {}", summary.error.empty() ? "" : "; ", name_, reasonOf(error));
  }
  for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
}
}  // namespace scanloom
