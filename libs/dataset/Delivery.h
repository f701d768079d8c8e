/** How completely, and in which order, a lidar's packets arrived. */
#pragma once
#include "dataset/PacketRuns.h"

#include <optional>

namespace scanloom
{
struct Delivery
{
  std::uint64_t packets = 0;  // received, duplicates included
  std::uint64_t lost = 0;     // between the first and the last of each run
  std::uint64_t gaps = 0;
  std::uint64_t longest_gap = 0;  // packets
  Duration longest_gap_time{0};   // that the lidar measured without us
  std::uint64_t duplicates = 0;
  std::uint64_t reordered = 0;    // came after a packet that was sent later
  std::int64_t displacement = 0;  // by how many packets it was overtaken, at most
  Duration displacement_time{0};  // at most, from the first packet that overtook it to its own arrival
  std::uint64_t restarts = 0;
  std::uint64_t blocks = 0, valid_blocks = 0;  // within the azimuth window

  /** Per second of arrival; none where arrival times span less than a turn. */
  std::optional<double> packet_rate, block_rate;
  double nominal_packet_rate = 0, nominal_block_rate = 0;

  std::uint64_t sent() const { return packets - duplicates + lost; }
  double lossShare() const { return sent() == 0 ? 0 : static_cast<double>(lost) / static_cast<double>(sent()); }
  double validShare() const
  {
    return blocks == 0 ? 0 : static_cast<double>(valid_blocks) / static_cast<double>(blocks);
  }
};

Delivery deliveryOf(const std::vector<PacketRun>&, const LidarDescription&);
}  // namespace scanloom
