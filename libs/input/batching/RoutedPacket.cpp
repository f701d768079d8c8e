#include "input/batching/RoutedPacket.h"

#include <algorithm>

namespace scanloom
{
std::optional<Timestamp> RoutedPacket::firstStamp() const
{
  const auto valid = std::find_if(blocks.begin(), blocks.end(), [](const MeasurementBlock& b) { return b.valid; });
  return valid == blocks.end() ? std::nullopt : std::optional(valid->stamp);
}

RoutedPacket readPacket(LidarIndex lidar, const PacketDecoder& decoder, PacketKind kind, Bytes bytes,
                        Timestamp received)
{
  RoutedPacket packet;
  packet.lidar = lidar;
  packet.kind = kind;
  packet.received = received;
  packet.bytes = bytes;
  if (kind != PacketKind::Lidar) return packet;
  packet.header = decoder.header(bytes);
  decoder.readBlocks(bytes, packet.blocks);
  return packet;
}
}  // namespace scanloom
