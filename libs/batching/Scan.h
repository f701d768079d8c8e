#pragma once
#include "core/PointCloud.h"
#include "core/Time.h"

#include <bitset>
#include <cstdint>
#include <vector>

namespace scanloom
{
constexpr std::size_t kMostLidars = 256;

/** By sensor_id. */
using SensorMask = std::bitset<kMostLidars>;

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
  SensorMask missing;  // lidars that may lack blocks here: silent up to their deadline, or cut by the end of input

  Timestamp end() const { return start + period; }
  bool complete() const { return missing.none(); }
};

/**
 * A scan under construction, complete up to a point in time: its columns [0, end_column) are final. Slice `index` of
 * `count` adds [first_column, end_column), the blocks of [start + index T / count, start + (index + 1) T / count); the
 * last one shows the whole scan. Valid only while it is handed over.
 */
struct ScanSlice
{
  const Scan& scan;
  int index = 0;
  int count = 1;
  std::size_t first_column = 0;
  std::size_t end_column = 0;

  Timestamp begin() const { return scan.start + scan.period * index / count; }
  Timestamp end() const { return scan.start + scan.period * (index + 1) / count; }
};

/** What the slice adds, as a scan of its own period. */
Scan copyOf(const ScanSlice&);
}  // namespace scanloom
