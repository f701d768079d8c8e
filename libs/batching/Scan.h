#pragma once
#include "core/PointCloud.h"
#include "core/Time.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** One measurement block within a scan: its points stand side by side in Scan::points. */
struct Column
{
  Timestamp stamp;
  std::uint32_t first_point = 0;
  std::uint16_t count = 0;  // valid returns
  std::uint16_t measurement_id = 0;
  std::uint32_t frame_id = 0;
  std::uint8_t sensor_id = 0;
};

/**
 * What all lidars measured in [start, start + period). Columns are ordered by (stamp, sensor_id, measurement_id) and
 * never go back in time, within a scan or from scan to scan. Points are in the body frame of their own instant.
 */
struct Scan
{
  Timestamp start;
  Duration period{0};
  std::vector<Column> columns;
  PointCloud points;                      // t is ns after start
  std::vector<std::uint32_t> columns_of;  // per sensor_id: how many columns it gave, 0 if it was silent
  bool complete = true;  // false: closed without waiting for a silent lidar, or cut by the end of input

  Timestamp end() const { return start + period; }
};
}  // namespace scanloom
