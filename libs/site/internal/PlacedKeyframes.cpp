#include "site/internal/PlacedKeyframes.h"

#include "mrpt/maps/MapFiles.h"
#include "site/internal/MapTile.h"

namespace scanloom
{
namespace
{
std::uint64_t numberOf(const octomap::OcTreeKey& key)
{
  return std::uint64_t{key[0]} << 32 | std::uint64_t{key[1]} << 16 | key[2];
}

void leaveOutGone(Keyframe& keyframe, std::size_t drive, const GoneVoxels& gone)
{
  const octomap::OcTree grid(tileOptions().resolution);
  std::vector<std::uint8_t> stands(keyframe.points.size(), 1);
  for (std::size_t i = 0; i < stands.size(); ++i)
  {
    const Eigen::Vector3f p = (keyframe.map_T_body * keyframe.points.position(i).cast<double>().eval()).cast<float>();
    octomap::OcTreeKey key;
    if (grid.coordToKeyChecked({p.x(), p.y(), p.z()}, key) && gone.isGone(key, drive)) stands[i] = 0;
  }
  keyframe.points.keep(stands);
}
}  // namespace

void GoneVoxels::add(const octomap::OcTreeKey& key, std::size_t gone_by)
{
  std::size_t& last = gone_by_[numberOf(key)];
  last = std::max(last, gone_by);
}

bool GoneVoxels::isGone(const octomap::OcTreeKey& key, std::size_t seen_by) const
{
  const auto found = gone_by_.find(numberOf(key));
  return found != gone_by_.end() && seen_by < found->second;
}

PlacedKeyframes::PlacedKeyframes(const Site& site, const std::vector<SiteDrive>& drives)
  : site_(site),
    drives_(drives),
    rig_(drives),
    offset_(offsetFor(site.keyframes[site.pieces.front().keyframes.front()].site_T_body))
{
}

Keyframe PlacedKeyframes::at(std::size_t keyframe) const
{
  Keyframe placed = lessOffset(keyframe);
  placed.map_T_body = site_.keyframes[keyframe].site_T_body;
  return placed;
}

Keyframe PlacedKeyframes::lessOffset(std::size_t keyframe) const
{
  const SiteKeyframe& in_site = site_.keyframes[keyframe];
  Keyframe placed = rig_.withIds(in_site.drive, drives_[in_site.drive].keyframe(in_site.index));
  placed.map_T_body = {in_site.site_T_body.rotation, in_site.site_T_body.translation - offset_};
  if (!gone_.empty()) leaveOutGone(placed, in_site.drive, gone_);
  return placed;
}
}  // namespace scanloom
