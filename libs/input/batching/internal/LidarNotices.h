#pragma once
#include "input/batching/internal/Notice.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** Collects notices, and remembers what was said of each lidar so that nothing is said twice. */
class LidarNotices
{
 public:
  explicit LidarNotices(std::size_t lidars) : lidars_(lidars) {}

  void note(LidarIndex, Notice::Kind, Timestamp now, Duration = Duration{0});

  /** A notice if they differ from those of the lidar's packet before. */
  void noteFlags(LidarIndex, std::uint32_t flags, Timestamp now);

  /** A packet with blocks for scans has come. */
  void noteArrival(LidarIndex, Timestamp received);

  /** A notice once: until noteBack. */
  void noteSilent(LidarIndex, Timestamp now);

  /** A notice if the lidar was called silent. */
  void noteBack(LidarIndex, Timestamp now);

  /** Those since the last call. */
  std::vector<Notice> take();

 private:
  struct Lidar
  {
    std::uint32_t flags = 0;
    std::optional<Timestamp> latest_arrival;
    Duration silence{0};  // before the latest arrival
    bool silent = false;  // as the latest notice says
  };

  std::vector<Lidar> lidars_;
  std::vector<Notice> notices_;
};
}  // namespace scanloom
