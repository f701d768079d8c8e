#include "site/internal/RigOfDrives.h"

#include "input/rig/RecordingHeader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
RigOfDrives::RigOfDrives(const std::vector<SiteDrive>& drives)
{
  for (const SiteDrive& drive : drives)
  {
    ids_.emplace_back();
    for (const MountedLidar& lidar : drive.lidars()) ids_.back().push_back(idOf(lidar));
  }
}

std::uint8_t RigOfDrives::idOf(const MountedLidar& lidar)
{
  constexpr double kSamePose = 1e-6;
  for (std::size_t i = 0; i < lidars_.size(); ++i)
    if (lidars_[i].name == lidar.name && boxMinus(lidars_[i].body_T_sensor, lidar.body_T_sensor).norm() < kSamePose)
      return static_cast<std::uint8_t>(i);
  lidars_.push_back(lidar);
  if (lidars_.size() > kMostLidars)
    throw std::runtime_error(fmt::format("the drives have more than {} different lidars", kMostLidars));
  return static_cast<std::uint8_t>(lidars_.size() - 1);
}

Keyframe RigOfDrives::withIds(std::size_t drive, Keyframe keyframe) const
{
  for (std::uint8_t& id : keyframe.points.sensor_id) id = ids_[drive][id];
  return keyframe;
}
}  // namespace scanloom
