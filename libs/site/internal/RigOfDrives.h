/** Lidars of several drives, whose machines may differ. */
#pragma once
#include "base/core/Keyframe.h"
#include "site/SiteDrive.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
class RigOfDrives
{
 public:
  /** Lidars of equal name and pose count as one. Throws std::runtime_error if there are more than sensor ids. */
  explicit RigOfDrives(const std::vector<SiteDrive>&);

  const std::vector<MountedLidar>& lidars() const { return lidars_; }

  /** A keyframe of the drive, with sensor ids by lidars(). */
  Keyframe withIds(std::size_t drive, Keyframe) const;

 private:
  std::uint8_t idOf(const MountedLidar&);

  std::vector<MountedLidar> lidars_;
  std::vector<std::vector<std::uint8_t>> ids_;  // by drive, then by the drive's own ids
};
}  // namespace scanloom
