/** Keyframes of all drives numbered in a row, and the parts of the drives in which the body was never lost. */
#pragma once
#include "site/SiteDrive.h"
#include "site/internal/Odometry.h"

#include <vector>

namespace scanloom
{
/** Keyframes `begin` to before `end`, of one drive. */
struct SitePart
{
  std::size_t drive = 0, begin = 0, end = 0;
};

class SiteLayout
{
 public:
  explicit SiteLayout(const std::vector<SiteDrive>&);

  std::size_t size() const { return part_of_.size(); }
  const std::vector<SitePart>& parts() const { return parts_; }
  std::size_t partOf(std::size_t keyframe) const { return part_of_[keyframe]; }
  std::size_t driveOf(std::size_t keyframe) const { return parts_[part_of_[keyframe]].drive; }

  /** Number of the keyframe within its drive. */
  std::size_t indexOf(std::size_t keyframe) const { return keyframe - first_of_drive_[driveOf(keyframe)]; }
  std::size_t firstOf(std::size_t drive) const { return first_of_drive_[drive]; }

  /** Of two keyframes of one part: length of the way between them, and how far odometry may be off on it (m). */
  double way(std::size_t a, std::size_t b) const;
  double drift(std::size_t a, std::size_t b) const;

  /** Keyframes of the same part whose way to this one is not longer (m), with itself. */
  std::vector<std::size_t> within(double way, std::size_t of) const;

 private:
  std::vector<SitePart> parts_;
  std::vector<std::size_t> part_of_, first_of_drive_;
  std::vector<OdometryDrift> drifts_;  // by drive
};
}  // namespace scanloom
