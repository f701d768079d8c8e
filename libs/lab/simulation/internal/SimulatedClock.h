/** When a lidar measures its columns, in true time and by its own clock. */
#pragma once
#include "base/core/Time.h"
#include "input/lidar/OusterMetadata.h"

#include <cstdint>

namespace scanloom
{
/** The error of a sensor's clock. */
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

/** Lidars are not phase locked: each starts at its own angle and time, and its rotor has an error of rate. */
struct LidarTiming
{
  Timestamp start;            // of the recording
  Duration first_column{0};   // after `start`
  double rate_error_ppm = 0;  // positive: the rotor is too slow
  std::uint32_t first_frame_id = 0;
  std::uint16_t first_measurement_id = 0;  // the first one of a packet
  ClockError clock;
};

struct ColumnInstant
{
  Timestamp truth;  // true time
  Timestamp stamp;  // of the sensor's clock
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;
};

/** The instant of the n-th column. */
ColumnInstant columnInstant(const LidarTiming&, const OusterMetadata&, std::uint64_t column);
}  // namespace scanloom
