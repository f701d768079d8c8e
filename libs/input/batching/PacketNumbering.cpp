#include "input/batching/PacketNumbering.h"

#include "input/lidar/AzimuthWindow.h"

#include <algorithm>

namespace scanloom
{
namespace
{
std::int64_t floorDiv(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : (a + 1) / b - 1; }
}  // namespace

PacketNumbering::PacketNumbering(const LidarDescription& lidar) : columns_per_packet_(lidar.columns_per_packet)
{
  const int columns = lidar.columns_per_frame;
  sent_before_.push_back(0);
  for (int first = 0; first < columns; first += lidar.columns_per_packet)
  {
    bool sent = false;
    for (int c = first; c < std::min(first + lidar.columns_per_packet, columns); ++c) sent |= inAzimuthWindow(lidar, c);
    sent_before_.push_back(sent_before_.back() + (sent ? 1 : 0));
  }
  for (int column = 0; column < columns; ++column)
  {
    int blocks = 1;
    while (blocks < columns && !inAzimuthWindow(lidar, (column + blocks) % columns)) ++blocks;
    blocks_to_next_.push_back(blocks);
  }
}

std::int64_t PacketNumbering::packetOf(std::int64_t block) const
{
  const std::int64_t turn = floorDiv(block, blocksPerTurn());
  return turn * packetsPerTurn() + (block - turn * blocksPerTurn()) / columns_per_packet_;
}

std::int64_t PacketNumbering::sentBefore(std::int64_t packet) const
{
  const std::int64_t turn = floorDiv(packet, packetsPerTurn());
  return turn * sent_before_.back() + sent_before_[static_cast<std::size_t>(packet - turn * packetsPerTurn())];
}

int PacketNumbering::blocksToNext(std::int64_t block) const
{
  const std::int64_t turn = floorDiv(block, blocksPerTurn());
  return blocks_to_next_[static_cast<std::size_t>(block - turn * blocksPerTurn())];
}
}  // namespace scanloom
