#pragma once
#include "input/lidar/PacketDecoder.h"

#include <cstdint>

namespace scanloom
{
/**
 * What became of everything that one lidar sent: a table with one row per count. For blocks, once input has ended:
 *
 *   received = emitted + late + duplicate + invalid + before_start + implausible + quarantined + dropped
 *   sent     = received + lost
 */
struct LidarCounters
{
  std::uint64_t packets = 0;            // lidar packets that were taken
  std::uint64_t malformed_packets = 0;  // neither size nor type is one that the lidar sends
  std::uint64_t bad_crc_packets = 0;
  std::uint64_t foreign_packets = 0;   // another sensor's
  std::uint64_t other_packets = 0;     // of a known type that holds nothing for scans
  std::uint64_t doubtful_packets = 0;  // ids or stamps contradict the packets before and after: damaged
  std::uint64_t restarts = 0;
  std::uint64_t clock_steps = 0;
  std::uint64_t alert_packets = 0;  // with alert flags, thermal or shot limiting status
  std::uint64_t missed_scans = 0;   // closed when this lidar's deadline had passed

  std::uint64_t received = 0;  // blocks in the packets taken
  std::uint64_t emitted = 0;   // blocks that became columns
  std::uint64_t late = 0;      // newer blocks, or their slice, had already been given out
  std::uint64_t duplicate = 0;
  std::uint64_t invalid =
      0;  // the sensor says so (edge of an azimuth window, start of the motor), or the stamp is decades off
  std::uint64_t before_start = 0;  // older than the start of the first scan, eq. (1)
  std::uint64_t implausible = 0;   // ids or stamp contradict the other blocks of their packet
  std::uint64_t quarantined = 0;   // the lidar does not share the others' clock and is left out
  std::uint64_t dropped = 0;       // queue full
  std::uint64_t lost = 0;          // never arrived: gaps in the ids that no packet filled before its deadline
  std::uint64_t points = 0;

  std::uint64_t sent() const { return received + lost; }
};

/** Whether this is a lidar packet; any other kind is counted. */
bool countUnlessLidar(PacketKind, LidarCounters&);

/** Calls visit(name, count) for each, under the names of reports. */
template <typename Visitor>
void forEachCount(const LidarCounters& c, Visitor&& visit)
{
  visit("packets", c.packets);
  visit("packets_malformed", c.malformed_packets);
  visit("packets_bad_crc", c.bad_crc_packets);
  visit("packets_foreign", c.foreign_packets);
  visit("packets_other", c.other_packets);
  visit("packets_doubtful", c.doubtful_packets);
  visit("restarts", c.restarts);
  visit("clock_steps", c.clock_steps);
  visit("packets_alert", c.alert_packets);
  visit("scans_missed", c.missed_scans);
  visit("blocks_sent", c.sent());
  visit("blocks_received", c.received);
  visit("blocks_emitted", c.emitted);
  visit("blocks_late", c.late);
  visit("blocks_duplicate", c.duplicate);
  visit("blocks_invalid", c.invalid);
  visit("blocks_before_start", c.before_start);
  visit("blocks_implausible", c.implausible);
  visit("blocks_quarantined", c.quarantined);
  visit("blocks_dropped", c.dropped);
  visit("blocks_lost", c.lost);
  visit("points", c.points);
}
}  // namespace scanloom
