/** When a lidar takes its columns, and what its clock says then. */
#pragma once
#include "core/Time.h"
#include "lidar/OusterMetadata.h"

#include <cstdint>

namespace scanloom
{
/** A sensor's stamps against true time. */
struct ClockError
{
  Duration offset{0};
  double drift_ppm = 0;
  Duration jump{0};
  Duration jump_at{0};  // after the recording's start; 0: never

  Timestamp stamp(Timestamp truth, Timestamp start) const
  {
    const Duration since_start = truth - start;
    const bool jumped = jump_at > Duration{0} && since_start >= jump_at;
    return truth + offset + fromSeconds(1e-6 * drift_ppm * seconds(since_start)) + (jumped ? jump : Duration{0});
  }
};

/** No phase lock: each lidar starts at some angle, at some time, and turns at a slightly wrong rate. */
struct LidarTiming
{
  Timestamp start;            // of the recording
  Duration first_column{0};   // after it
  double rate_error_ppm = 0;  // positive: columns come later than they should
  std::uint32_t first_frame_id = 0;
  std::uint16_t first_measurement_id = 0;  // begins a packet
  ClockError clock;
};

struct ColumnInstant
{
  Timestamp truth;  // of the world
  Timestamp stamp;  // by the sensor's clock
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;
};

/** Of the n-th column. */
ColumnInstant columnInstant(const LidarTiming&, const OusterMetadata&, std::uint64_t column);
}  // namespace scanloom
