#pragma once
#include "input/batching/Scan.h"
#include "input/lidar/PacketDecoder.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** What one lidar measured in one turn: from its encoder's zero to the next. */
struct Turn
{
  std::vector<Column> columns;  // in the order of arrival
  PointCloud points;            // in the body frame of their own instant; t is ns after `origin`
  Timestamp origin;             // stamp of the column that came first
  Timestamp first, last;        // smallest and largest stamp of the columns
  bool whole = true;            // received from its first packet to its last, nothing missing

  Timestamp middle() const { return first + (last - first) / 2; }

  /** Converts a block of `packet`; its stamp must be within 2 s of `origin`. */
  void add(const PacketDecoder&, Bytes packet, const MeasurementBlock&, std::uint8_t sensor_id);
};

/** With room for a few more points than the turn before had. */
Turn emptyTurn(std::size_t points_of_turn_before);
}  // namespace scanloom
