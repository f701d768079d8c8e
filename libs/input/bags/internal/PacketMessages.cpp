#include "input/bags/internal/PacketMessages.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace scanloom
{
namespace
{
// uint8[N] of the message definitions
constexpr std::size_t kVelodyneBytes = 1206, kUsedUpTo = 1500, kRslidarBytes = 1248;

std::optional<Timestamp> stampIn(MessageReader& message)
{
  const Timestamp stamp = message.time();
  return stamp == Timestamp{} ? std::nullopt : std::optional(stamp);
}

/** uint8[] buf */
PacketInMessage ousterPacket(MessageReader& message) { return {std::nullopt, message.byteSequence()}; }

/** time stamp, uint8[N] data */
template <std::size_t kBytes>
PacketInMessage stampedArray(MessageReader& message)
{
  const auto stamp = stampIn(message);
  return {stamp, message.bytes(kBytes)};
}

/** time stamp, uint8[1500] data, uint32 size */
PacketInMessage pandarPacket(MessageReader& message)
{
  const auto stamp = stampIn(message);
  const Bytes data = message.bytes(kUsedUpTo);
  return {stamp, data.slice(0, message.number<std::uint32_t>())};
}

/** time stamp, uint8 kind, uint8[1500] data, uint32 size */
PacketInMessage robosensePacket(MessageReader& message)
{
  const auto stamp = stampIn(message);
  message.bytes(1);
  const Bytes data = message.bytes(kUsedUpTo);
  return {stamp, data.slice(0, message.number<std::uint32_t>())};
}

/** time stamp, uint8[] data */
PacketInMessage stampedSequence(MessageReader& message)
{
  const auto stamp = stampIn(message);
  return {stamp, message.byteSequence()};
}

/** uint8 is_difop, uint8 is_frame_begin, uint8[] data, behind the message's header */
PacketInMessage rslidarPacket(MessageReader& message)
{
  message.bytes(2);
  return {std::nullopt, message.byteSequence()};
}

struct PacketType
{
  std::string_view type;
  bool has_header;
  std::size_t least_bytes;  // of a packet of a sequence of them; 0: the message is one packet
  PacketInMessage (*read)(MessageReader&);
};

constexpr std::size_t kStamp = 8;
constexpr std::array kPacketTypes{
    PacketType{"ouster_ros/PacketMsg", false, 0, &ousterPacket},
    PacketType{"ouster_sensor_msgs/PacketMsg", false, 0, &ousterPacket},
    PacketType{"velodyne_msgs/VelodyneScan", true, kStamp + kVelodyneBytes, &stampedArray<kVelodyneBytes>},
    PacketType{"velodyne_msgs/VelodynePacket", false, 0, &stampedArray<kVelodyneBytes>},
    PacketType{"pandar_msgs/PandarScan", true, kStamp + kUsedUpTo + 4, &pandarPacket},
    PacketType{"nebula_msgs/NebulaPackets", true, kStamp + 4, &stampedSequence},
    PacketType{"robosense_msgs/RobosenseScan", true, kStamp + 1 + kUsedUpTo + 4, &robosensePacket},
    PacketType{"robosense_msgs/RobosensePacket", false, 0, &robosensePacket},
    PacketType{"rslidar_msgs/rslidarScan", true, kStamp + kRslidarBytes, &stampedArray<kRslidarBytes>},
    PacketType{"rslidar_msgs/rslidarPacket", false, 0, &stampedArray<kRslidarBytes>},
    PacketType{"rslidar_msg/RslidarPacket", true, 0, &rslidarPacket},
};

const PacketType* packetType(const std::string& type)
{
  const auto found = std::find_if(kPacketTypes.begin(), kPacketTypes.end(),
                                  [&](const PacketType& known) { return known.type == type; });
  return found == kPacketTypes.end() ? nullptr : &*found;
}
}  // namespace

bool isPacketType(const std::string& type) { return packetType(type) != nullptr; }

void forEachPacket(const BagTopic& topic, Bytes message, const std::function<void(const PacketInMessage&)>& take)
{
  const PacketType* type = packetType(topic.type);
  if (!type) return;
  MessageReader reader(message, topic.serialisation);
  if (type->has_header) reader.header();
  const std::size_t packets = type->least_bytes == 0 ? 1 : reader.count(type->least_bytes);
  for (std::size_t i = 0; i < packets; ++i) take(type->read(reader));
}

std::string frameOfPackets(const BagTopic& topic, Bytes message)
{
  const PacketType* type = packetType(topic.type);
  return type && type->has_header ? MessageReader(message, topic.serialisation).header().frame : "";
}
}  // namespace scanloom
