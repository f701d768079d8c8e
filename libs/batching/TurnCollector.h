#pragma once
#include "batching/Counters.h"
#include "batching/Scan.h"
#include "lidar/PacketDecoder.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** What one lidar measured in one turn: from its encoder's zero to the next. */
struct Turn
{
  std::vector<Column> columns;  // in the order of arrival, at least one
  PointCloud points;            // in the body frame of their own instant; t is ns after `origin`
  Timestamp origin;             // stamp of the column that came first
  Timestamp first, last;        // smallest and largest stamp of the columns
  bool whole = true;            // seen from its beginning to its end, no packet missing

  Timestamp middle() const { return first + (last - first) / 2; }
};

/**
 * Batching by spinning angle, as drivers do it: blocks are converted as they come and belong to the turn that their
 * frame id names. A turn is given out with its last packet, or when a later one begins without it.
 */
class TurnCollector
{
 public:
  TurnCollector(std::shared_ptr<const PacketDecoder>, Duration time_offset, std::uint8_t sensor_id);

  /** Turns that are over with this packet, oldest first. Every block is counted, except as emitted or dropped. */
  std::vector<Turn> push(Bytes packet, LidarCounters&);

  /** No more packets: the turn under way, if there is one, cut. */
  std::vector<Turn> finish(LidarCounters&);

  /** The smallest stamp of the turn under way; none between two turns. */
  std::optional<Timestamp> underWaySince() const;

  /** Nominal, of a turn. */
  Duration period() const { return period_; }

 private:
  /** The newest turn heard of; when it has been given out, what is left of it tells what comes twice or late. */
  struct Newest
  {
    std::uint32_t frame_id = 0;
    std::vector<bool> arrived;       // by packet of the turn
    std::size_t first_expected = 0;  // the packets before this went out before we listened
    std::optional<Turn> turn = Turn{};
  };

  std::vector<Turn> startTurnOf(const PacketHeader&, std::uint32_t frame_id, std::size_t packet_of_turn,
                                LidarCounters&);
  std::int64_t turnsAhead(std::uint32_t frame_id) const;
  void beginTurn(std::uint32_t frame_id, std::size_t first_expected);
  void addColumns(Bytes packet, LidarCounters&);
  std::size_t missingUntil(std::size_t packet_of_turn) const;
  void giveOut(std::size_t expected_until, std::vector<Turn>& over, LidarCounters&);

  std::shared_ptr<const PacketDecoder> decoder_;
  Duration time_offset_;
  std::uint8_t sensor_id_;
  Duration period_;
  std::vector<bool> sent_;  // by packet of a turn: some of its columns lie within the azimuth window
  std::optional<Newest> newest_;
  std::optional<std::uint32_t> init_id_;
  std::vector<MeasurementBlock> blocks_;  // of the packet in hand; kept for its memory
};
}  // namespace scanloom
