/** Keyframes of a site with their points, which are read from the drives when they are asked for. */
#pragma once
#include "site/Site.h"
#include "site/internal/RigOfDrives.h"

#include <octomap/OcTree.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace scanloom
{
/** Voxels of tileOptions() in which nothing stands any more. */
class GoneVoxels
{
 public:
  void add(const octomap::OcTreeKey&, std::size_t gone_by);

  /** Whether what a drive saw in the voxel is gone. */
  bool isGone(const octomap::OcTreeKey&, std::size_t seen_by) const;

  bool empty() const { return gone_by_.empty(); }

 private:
  std::unordered_map<std::uint64_t, std::size_t> gone_by_;
};

class PlacedKeyframes
{
 public:
  /** Site and drives must outlive it. */
  PlacedKeyframes(const Site&, const std::vector<SiteDrive>&);

  const std::vector<MountedLidar>& lidars() const { return rig_.lidars(); }

  /** Less than the site's coordinates: what floats hold of those of a country. */
  const Eigen::Vector3d& offset() const { return offset_; }

  /** Points that are gone are left out from now on; voxels are those of coordinates less offset(). */
  void leaveOut(GoneVoxels gone) { gone_ = std::move(gone); }

  /** Where it is in the site, with sensor_ids by lidars(). */
  Keyframe at(std::size_t keyframe) const;

  /** The same less offset(). */
  Keyframe lessOffset(std::size_t keyframe) const;

 private:
  const Site& site_;
  const std::vector<SiteDrive>& drives_;
  RigOfDrives rig_;
  Eigen::Vector3d offset_;
  GoneVoxels gone_;
};
}  // namespace scanloom
