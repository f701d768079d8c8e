#pragma once

namespace scanloom
{
/**
 * Whether the lidar measures in a column. The azimuth window is [first_column, last_column], and wraps around column 0
 * if first_column > last_column. `Lidar` is a LidarDescription or an OusterMetadata.
 */
template <typename Lidar>
bool inAzimuthWindow(const Lidar& lidar, int column)
{
  const bool from_first = column >= lidar.first_column, to_last = column <= lidar.last_column;
  return lidar.first_column <= lidar.last_column ? from_first && to_last : from_first || to_last;
}
}  // namespace scanloom
