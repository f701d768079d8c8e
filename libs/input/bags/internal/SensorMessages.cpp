#include "input/bags/internal/SensorMessages.h"

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kUnitTolerance = 0.01;

Eigen::Vector3d vectorIn(MessageReader& message)
{
  const auto x = message.number<double>(), y = message.number<double>();
  return {x, y, message.number<double>()};
}

/** As it is written, x y z w. */
Eigen::Quaterniond quaternionIn(MessageReader& message)
{
  const Eigen::Vector3d axis = vectorIn(message);
  return {message.number<double>(), axis.x(), axis.y(), axis.z()};
}

bool isRotation(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1) < kUnitTolerance; }

/** An orientation that was never set is all 0: it is none. */
Eigen::Quaterniond rotationOr(const Eigen::Quaterniond& q)
{
  return isRotation(q) ? q.normalized() : Eigen::Quaterniond::Identity();
}

void skipCovariance(MessageReader& message, int elements)
{
  for (int i = 0; i < elements; ++i) message.number<double>();
}

/** tf of ROS 1 allowed a '/' in front. */
std::string plainFrame(std::string frame)
{
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
  return frame;
}
}  // namespace

ImuMessage imuOf(const BagTopic& topic, Bytes bytes)
{
  MessageReader message(bytes, topic.serialisation);
  const MessageHeader header = message.header();
  ImuMessage imu;
  imu.frame = plainFrame(header.frame);
  imu.sample.stamp = header.stamp;
  quaternionIn(message);
  skipCovariance(message, 9);
  imu.sample.gyro = vectorIn(message);
  skipCovariance(message, 9);
  imu.sample.accel = vectorIn(message);
  return imu;
}

std::vector<FrameTransform> transformsOf(const BagTopic& topic, Bytes bytes)
{
  constexpr std::size_t kLeastBytes = 8 + 4 + 4 + 7 * sizeof(double);  // stamp, two empty names, transform
  MessageReader message(bytes, topic.serialisation);
  std::vector<FrameTransform> transforms;
  for (std::size_t left = message.count(kLeastBytes); left > 0; --left)
  {
    FrameTransform transform;
    transform.parent = plainFrame(message.header().frame);
    transform.child = plainFrame(message.string());
    transform.parent_T_child.translation = vectorIn(message);
    const Eigen::Quaterniond rotation = quaternionIn(message);
    transform.parent_T_child.rotation = rotation.normalized();
    if (isRotation(rotation) && transform.parent_T_child.translation.allFinite()) transforms.push_back(transform);
  }
  return transforms;
}

bool isPoseType(const std::string& type)
{
  return type == "nav_msgs/Odometry" || type == "geometry_msgs/PoseStamped" || type == "geometry_msgs/PointStamped";
}

StampedPose poseOf(const BagTopic& topic, Bytes bytes)
{
  if (!isPoseType(topic.type)) throw std::invalid_argument(topic.type + " holds no pose");
  MessageReader message(bytes, topic.serialisation);
  StampedPose pose{message.header().stamp, Rigid::identity()};
  if (topic.type == "nav_msgs/Odometry") message.string();  // frame of the body
  pose.map_T_body.translation = vectorIn(message);
  if (topic.type != "geometry_msgs/PointStamped") pose.map_T_body.rotation = rotationOr(quaternionIn(message));
  return pose;
}

std::string textOf(const BagTopic& topic, Bytes bytes) { return MessageReader(bytes, topic.serialisation).string(); }
}  // namespace scanloom
