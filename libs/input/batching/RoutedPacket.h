#pragma once
#include "input/lidar/PacketDecoder.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** A lidar's place in the list of lidars; it is also the sensor_id of its points. */
using LidarIndex = std::size_t;

/**
 * A datagram that is one lidar's, classified and read once: PacketRouter makes it, everybody behind it takes it as it
 * is. The bytes belong to somebody else and are valid only while the packet is handed on.
 */
struct RoutedPacket
{
  LidarIndex lidar = 0;
  PacketKind kind = PacketKind::Other;
  Timestamp received;  // host time, or the record time of a capture
  Bytes bytes;
  bool of_new_sender = false;            // not from where the lidar's packets came before
  PacketHeader header;                   // of a lidar packet
  std::vector<MeasurementBlock> blocks;  // of a lidar packet: all of them, in the packet's order

  /** Of the first valid block; none if there is none. */
  std::optional<Timestamp> firstStamp() const;
};

/** `kind` is what the decoder's kind() says of these bytes: header and blocks of a lidar packet are read here. */
RoutedPacket readPacket(LidarIndex, const PacketDecoder&, PacketKind, Bytes, Timestamp received);
}  // namespace scanloom
