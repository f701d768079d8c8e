/** Scans apart by lidar, in the frames of the lidars: whatever their poses on the body are. */
#pragma once
#include "base/core/MountedLidar.h"
#include "input/batching/Scan.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** What one lidar measured during a scan. Points of a column are neighbours and have the same t. */
struct LidarScan
{
  Timestamp start;
  Duration period{0};
  std::vector<Eigen::Vector3f> points;  // m, in the sensor frame, each at its own time
  std::vector<std::int32_t> t;          // ns after start, by point

  Timestamp middle() const { return start + period / 2; }
};

/**
 * Of each lidar at most 2^14 points of a scan (whole columns) and 600 scans, evenly chosen: beyond that every second
 * one is dropped, so that memory is bounded however long the drive is.
 */
class LidarScans
{
 public:
  /** `lidars` by sensor id, with the poses by which the scans were brought into the body frame. */
  explicit LidarScans(std::vector<MountedLidar> lidars);

  void add(const Scan& scan_in_body);

  /** By sensor id, each in the order of time. A scan in which the lidar has no point is left out. */
  const std::vector<std::vector<LidarScan>>& byLidar() const { return scans_; }

 private:
  std::vector<MountedLidar> lidars_;
  std::vector<std::vector<LidarScan>> scans_;
  std::size_t seen_ = 0, every_nth_ = 1;
};
}  // namespace scanloom
