/** Messages of lidar drivers that hold raw packets. */
#pragma once
#include "input/bags/BagReader.h"

#include <functional>
#include <optional>

namespace scanloom
{
/** A packet within a message. */
struct PacketInMessage
{
  std::optional<Timestamp> stamp;  // by the computer that received it; none where the type has none, or it was left 0
  Bytes bytes;                     // a view of the message
};

/**
 * Whether messages of this type hold packets: PacketMsg of ouster_ros and ouster_sensor_msgs, VelodyneScan and
 * VelodynePacket of velodyne_msgs, pandar_msgs/PandarScan, nebula_msgs/NebulaPackets, RobosenseScan and
 * RobosensePacket of robosense_msgs, rslidarScan and rslidarPacket of rslidar_msgs, rslidar_msg/RslidarPacket.
 */
bool isPacketType(const std::string& type);

/**
 * Calls `take` for each packet of a message of such a type, in its order. Throws std::out_of_range for a message that
 * ends too early, after `take` was called for the packets before, and std::invalid_argument for a serialisation that
 * can't be read.
 */
void forEachPacket(const BagTopic&, Bytes message, const std::function<void(const PacketInMessage&)>& take);

/** The frame of the message's header; empty for the types that have none. Throws as forEachPacket does. */
std::string frameOfPackets(const BagTopic&, Bytes message);
}  // namespace scanloom
