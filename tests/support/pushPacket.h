/** Packets for a batcher without a router: classified by the decoder of the lidar that the test names. */
#pragma once
#include "input/batching/TimeBatcher.h"

namespace scanloom
{
/** Anything else than a lidar packet where the decoder is not known. */
inline RoutedPacket packetOf(LidarIndex lidar, const PacketDecoder* decoder, Bytes bytes, Timestamp received)
{
  if (decoder) return readPacket(lidar, *decoder, decoder->kind(bytes), bytes, received);
  RoutedPacket packet;
  packet.lidar = lidar;
  packet.received = received;
  packet.bytes = bytes;
  return packet;
}

inline std::vector<Scan> push(TimeBatcher& batcher, LidarIndex lidar, Bytes bytes, Timestamp received)
{
  return batcher.push(packetOf(lidar, batcher.lidars()[lidar].decoder.get(), bytes, received));
}

/** Blocks that were received and are in no other count yet: I3 and I5 of the fault table. */
inline std::uint64_t blocksWaiting(const LidarCounters& c)
{
  return c.received -
         (c.emitted + c.late + c.duplicate + c.invalid + c.before_start + c.implausible + c.quarantined + c.dropped);
}
}  // namespace scanloom
