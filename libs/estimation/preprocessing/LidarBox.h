#pragma once
#include "base/core/MountedLidar.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** A box that is fixed to a lidar, for example around its bracket. */
struct LidarBox
{
  std::uint8_t sensor_id = 0;
  Rigid sensor_T_body;
  Eigen::AlignedBox3d box;  // in the lidar's frame
};

/** "x0 y0 z0 x1 y1 z1", the first corner below the second on each axis; none if it is anything else. */
std::optional<Eigen::AlignedBox3d> parseBox(const std::string&);

/**
 * From "left -1 -1 -1 1 1 1, right ..."; a lidar may have several. Throws ConfigError for a name that none of the
 * lidars (by sensor id) has, and for text that is not a box.
 */
std::vector<LidarBox> lidarBoxes(const std::string& text, const std::vector<MountedLidar>& lidars);
}  // namespace scanloom
