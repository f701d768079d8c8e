#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Time.h"

#include <bitset>
#include <cstdint>
#include <functional>
#include <vector>

namespace scanloom
{
constexpr std::size_t kMostLidars = 256;

/** By sensor_id. */
using SensorMask = std::bitset<kMostLidars>;

/** One measurement block of a scan; its points are neighbours in Scan::points. */
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
 * What all lidars measured in [start, start + period). Columns are ordered by (stamp, sensor_id, measurement_id), so
 * time never goes back within a scan or from scan to scan. A point is in the body frame at its own time of measurement.
 */
struct Scan
{
  Timestamp start;
  Duration period{0};
  std::vector<Column> columns;
  PointCloud points;                      // t is ns after start
  std::vector<std::uint32_t> columns_of;  // per sensor_id: number of its columns, 0 if it was silent
  SensorMask missing;  // lidars of which blocks may be missing: their deadline passed, or the input ended

  Timestamp end() const { return start + period; }
  bool complete() const { return missing.none(); }
};

/**
 * Part `index` of `count` of a scan under construction. It adds the columns [first_column, end_column), which are those
 * of [start + index T / count, start + (index + 1) T / count); the columns before end_column are final, and with the
 * last slice the scan is complete. The reference is valid only during the call.
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

using SliceSink = std::function<void(const ScanSlice&)>;

/** What the slice adds, as a scan of its own period. */
Scan copyOf(const ScanSlice&);
}  // namespace scanloom
