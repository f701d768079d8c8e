#pragma once
#include "batching/Counters.h"
#include "batching/Turn.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Batching by spinning angle, as drivers do it: the blocks of one lidar are converted as they come and belong to the
 * turn that their numbers name.
 */
class TurnCollector
{
 public:
  virtual ~TurnCollector() = default;

  /**
   * Turns that are over with this packet, oldest first. `blocks` are all of the packet's, at least one; those that are
   * valid are counted unless they become columns, and so is what is lost.
   */
  virtual std::vector<Turn> push(Bytes packet, const std::vector<MeasurementBlock>& blocks, Timestamp received,
                                 LidarCounters&) = 0;

  /** No more packets: the turn under way, if there is one, cut. */
  virtual std::vector<Turn> finish(LidarCounters&) = 0;

  /** The smallest stamp of the turn under way; none between two turns. */
  virtual std::optional<Timestamp> underWaySince() const = 0;

  /** The memory of a turn that nobody needs any more, for those to come. */
  void recycle(Turn&& turn) { spare_.push_back(std::move(turn)); }

 protected:
  Turn emptyTurn();

 private:
  std::vector<Turn> spare_;
};

/** For packets with frame ids: a turn is out with its last packet, or when a later one begins without it. */
std::unique_ptr<TurnCollector> makeFrameIdTurns(std::shared_ptr<const PacketDecoder>, Duration time_offset,
                                                std::uint8_t sensor_id);

/**
 * For packets without numbers (Numbering::Stamps): a turn is out when the measurement ids fall back by more than half
 * of what a turn sends. Blocks whose stamp is not later than the newest are late, whether they come twice or out of
 * order; lost are the packets that a gap in the stamps has room for. Stamps that wrap are taken to be those nearest to
 * the host's time first and nearest to each other after that.
 */
std::unique_ptr<TurnCollector> makeAzimuthTurns(std::shared_ptr<const PacketDecoder>, Duration time_offset,
                                                std::uint8_t sensor_id);
}  // namespace scanloom
