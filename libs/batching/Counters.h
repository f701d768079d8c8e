#pragma once
#include <cstdint>

namespace scanloom
{
/**
 * What became of everything that one lidar sent. Blocks, once input has ended:
 *
 *   received = emitted + late + duplicate + invalid + before_start + implausible + dropped
 *   sent     = received + lost
 */
struct LidarCounters
{
  std::uint64_t packets = 0;            // lidar packets that were taken
  std::uint64_t malformed_packets = 0;  // size or type fits nothing
  std::uint64_t bad_crc_packets = 0;
  std::uint64_t foreign_packets = 0;  // another sensor's
  std::uint64_t other_packets = 0;    // not of use here
  std::uint64_t restarts = 0;

  std::uint64_t received = 0;  // blocks in the packets taken
  std::uint64_t emitted = 0;   // blocks that became columns
  std::uint64_t late = 0;      // their place in time had already been given out
  std::uint64_t duplicate = 0;
  std::uint64_t invalid = 0;       // marked so by the sensor (edge of an azimuth window, start of the motor)
  std::uint64_t before_start = 0;  // older than the start of the first scan, eq. (1)
  std::uint64_t implausible = 0;   // stamp contradicts the arrival time or its own packet
  std::uint64_t dropped = 0;       // queue full
  std::uint64_t lost = 0;          // never arrived: gaps in the measurement ids that no packet filled in time
  std::uint64_t points = 0;

  std::uint64_t sent() const { return received + lost; }
};
}  // namespace scanloom
