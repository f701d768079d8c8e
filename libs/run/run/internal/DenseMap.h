/** The points of all scans of a localisation run, in one file. */
#pragma once
#include "base/core/BoundedQueue.h"
#include "base/formats/CloudWriter.h"
#include "estimation/ndt/CellKey.h"
#include "estimation/slam/StateEstimate.h"
#include "run/run/OutputOptions.h"
#include "run/run/internal/RunSummary.h"

#include <tsl/robin_set.h>

#include <cstdint>
#include <filesystem>
#include <future>
#include <string>

namespace scanloom
{
/**
 * dense_map.las, .laz, .pcd or .ply: cropped and deskewed points in the map frame, by the poses of trajectory.tum; none
 * of scans where the machine is LOST. A thread writes them in the order of the scans. Memory: 40 to 60 bytes per voxel.
 */
class DenseMap
{
 public:
  /** The file's name, if there is to be one. Throws ConfigError for an unknown format. */
  static std::string nameOf(const OutputOptions&);

  /** Throws as nameOf() does, and std::runtime_error if the file cannot be written. */
  DenseMap(const std::filesystem::path& folder, const OutputOptions&);
  DenseMap(const DenseMap&) = delete;
  DenseMap& operator=(const DenseMap&) = delete;
  ~DenseMap();

  /** Waits while eight scans wait. */
  void add(const StateEstimate&);

  /** Writes the rest, renames the file to its name, and adds its points and time to the summary, or why it failed. */
  void close(RunSummary&);

 private:
  void write();
  PointCloud firstInVoxels(PointCloud, const Rigid& map_T_points);

  std::string name_;
  double voxel_;  // m; 0: all points
  CloudWriter writer_;
  tsl::robin_set<std::uint64_t, KeyHash> taken_;  // only asked, never iterated
  StageTimes times_;                              // of the thread
  BoundedQueue<Keyframe> queue_;
  std::future<void> written_;  // last: its thread uses all of the above, and its destructor waits
};
}  // namespace scanloom
