/** How many of a lidar's packets arrived, at which rate and in which order. */
#pragma once
#include "diagnosis/internal/PacketRuns.h"

#include <optional>

namespace scanloom
{
struct PacketLoss
{
  std::uint64_t packets = 0;  // missing between the first and the last of each run
  std::uint64_t gaps = 0;
  std::uint64_t longest = 0;  // gap, in packets
  Duration longest_time{0};   // gap, in time that the lidar measured
};

struct PacketOrder
{
  std::uint64_t duplicates = 0;
  std::uint64_t reordered = 0;    // packets that came after one that was sent later
  std::int64_t displacement = 0;  // largest number of packets that overtook one
  Duration displacement_time{0};  // longest time from the first packet that overtook one to its own arrival
};

/** In Hz; measured ones over the time of arrival, none if that is less than a turn. */
struct DeliveryRates
{
  std::optional<double> packets, blocks;
  double nominal_packets = 0, nominal_blocks = 0;
};

struct Delivery
{
  std::uint64_t packets = 0;  // received, duplicates included
  std::uint64_t restarts = 0;
  std::uint64_t blocks = 0, valid_blocks = 0;  // within the azimuth window
  PacketLoss loss;
  PacketOrder order;
  DeliveryRates rates;

  std::uint64_t sent() const { return packets - order.duplicates + loss.packets; }
  double lossShare() const { return sent() == 0 ? 0 : static_cast<double>(loss.packets) / static_cast<double>(sent()); }
  double validShare() const
  {
    return blocks == 0 ? 0 : static_cast<double>(valid_blocks) / static_cast<double>(blocks);
  }
};

Delivery deliveryOf(const std::vector<PacketRun>&, const LidarDescription&);
}  // namespace scanloom
