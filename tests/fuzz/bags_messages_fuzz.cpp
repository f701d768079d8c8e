/**
 * Any bytes as a message of each type that is read, in either serialisation, as the first byte says: values, or
 * std::out_of_range or std::invalid_argument. fuzz options: -max_len=2048
 */
#include <stdexcept>

#include "input/bags/internal/CloudMessage.h"
#include "input/bags/internal/PacketMessages.h"
#include "input/bags/internal/SensorMessages.h"
#include "require.h"

using namespace scanloom;

namespace
{
void read(const BagTopic& topic, Bytes message)
{
  if (isPacketType(topic.type))
  {
    std::size_t bytes = 0;
    frameOfPackets(topic, message);
    forEachPacket(topic, message, [&](const PacketInMessage& packet) { bytes += packet.bytes.size(); });
    require(bytes <= message.size());
  }
  else if (topic.type == "sensor_msgs/Imu")
    imuOf(topic, message);
  else if (topic.type == "tf2_msgs/TFMessage")
    for (const FrameTransform& t : transformsOf(topic, message)) require(t.parent_T_child.translation.allFinite());
  else if (isCloudType(topic.type))
    require(makeCloudDecoder({}, Rigid::identity())->kind(cloudPacket(timedCloudOf(topic, message).points)) ==
            PacketKind::Lidar);
  else if (isPoseType(topic.type))
    poseOf(topic, message);
  else
    textOf(topic, message);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const char* const kTypes[] = {"ouster_ros/PacketMsg",
                                       "velodyne_msgs/VelodyneScan",
                                       "velodyne_msgs/VelodynePacket",
                                       "pandar_msgs/PandarScan",
                                       "nebula_msgs/NebulaPackets",
                                       "robosense_msgs/RobosenseScan",
                                       "robosense_msgs/RobosensePacket",
                                       "rslidar_msg/RslidarPacket",
                                       "sensor_msgs/Imu",
                                       "tf2_msgs/TFMessage",
                                       "nav_msgs/Odometry",
                                       "geometry_msgs/PointStamped",
                                       "std_msgs/String",
                                       "sensor_msgs/PointCloud2"};
  if (size == 0) return 0;
  const Serialisation serialisation = data[0] % 2 == 0 ? Serialisation::Cdr : Serialisation::Ros1;
  const auto readIt = [&] {
    read({"/topic", kTypes[data[0] / 2 % std::size(kTypes)], serialisation}, {data + 1, size - 1});
  };
  mayThrow<std::out_of_range>([&] { mayThrow<std::invalid_argument>(readIt); });
  return 0;
}
