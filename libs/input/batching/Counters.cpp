#include "input/batching/Counters.h"

namespace scanloom
{
bool countUnlessLidar(PacketKind kind, LidarCounters& count)
{
  switch (kind)
  {
    case PacketKind::Lidar:
      return true;
    case PacketKind::Malformed:
      ++count.malformed_packets;
      return false;
    case PacketKind::BadCrc:
      ++count.bad_crc_packets;
      return false;
    case PacketKind::Foreign:
      ++count.foreign_packets;
      return false;
    case PacketKind::Imu:
    case PacketKind::Other:
      break;
  }
  ++count.other_packets;
  return false;
}
}  // namespace scanloom
