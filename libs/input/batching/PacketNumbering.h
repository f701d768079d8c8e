#pragma once
#include "input/lidar/PacketDecoder.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/**
 * Numbers blocks and packets through all turns: block `frame * columns_per_frame + measurement_id`, the packets of each
 * turn counting from its block 0. Blocks and packets outside of the azimuth window, which are not sent, have numbers
 * too.
 */
class PacketNumbering
{
 public:
  explicit PacketNumbering(const LidarDescription&);

  int packetsPerTurn() const { return static_cast<int>(sent_before_.size()) - 1; }
  int blocksPerTurn() const { return static_cast<int>(blocks_to_next_.size()); }
  std::int64_t packetOf(std::int64_t block) const;

  /** How many packets within the azimuth window have a number below this one. */
  std::int64_t sentBefore(std::int64_t packet) const;

  /** Blocks from this one to the next within the azimuth window: 1 inside it. */
  int blocksToNext(std::int64_t block) const;

 private:
  int columns_per_packet_;
  std::vector<int> sent_before_;     // per packet of a turn, with the total at the end
  std::vector<int> blocks_to_next_;  // per column of a turn
};
}  // namespace scanloom
