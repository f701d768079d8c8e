#include "input/batching/RoutedPacket.h"

namespace scanloom
{
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
