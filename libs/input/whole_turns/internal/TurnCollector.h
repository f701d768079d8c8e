#pragma once
#include "input/batching/Counters.h"
#include "input/batching/RoutedPacket.h"
#include "input/whole_turns/internal/Turn.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** More turns than these are never reordered, and hardly lost: the lidar has started again. */
inline constexpr int kTurnsRemembered = 4;

/**
 * Batching by spinning angle, as drivers do it: the blocks of one lidar are converted as they come and belong to the
 * turn that their numbers name.
 */
class TurnCollector
{
 public:
  virtual ~TurnCollector() = default;

  /**
   * Turns that are complete with this lidar packet of at least one block, oldest first. Counts valid blocks that do not
   * become columns, and what is lost.
   */
  virtual std::vector<Turn> push(const RoutedPacket&, LidarCounters&) = 0;

  /** No more packets will come: the turn under way, if there is one, incomplete. */
  virtual std::vector<Turn> finish(LidarCounters&) = 0;

  /** The smallest stamp of the turn under way; none between two turns. */
  virtual std::optional<Timestamp> underWaySince() const = 0;
};

/** For packets with frame ids: a turn is complete with its last packet, or when a packet of a later turn comes. */
std::unique_ptr<TurnCollector> makeFrameIdTurns(std::shared_ptr<const PacketDecoder>, Duration time_offset,
                                                std::uint8_t sensor_id);

/**
 * For packets without ids (Numbering::Stamps): a turn is complete when the measurement ids fall back by more than half
 * of what a turn sends. Blocks whose stamp is not later than the newest are late, whether they come twice or out of
 * order; lost are as many packets as fit into a gap in the stamps. Stamps that wrap are unwrapped to those nearest to
 * host time at first, nearest to the newest one after that.
 */
std::unique_ptr<TurnCollector> makeAzimuthTurns(std::shared_ptr<const PacketDecoder>, Duration time_offset,
                                                std::uint8_t sensor_id);
}  // namespace scanloom
