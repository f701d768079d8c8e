/** Messages of ROS's common packages as plain values. All throw std::out_of_range for a message that ends too early. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/StampedPose.h"
#include "input/bags/BagReader.h"

#include <string>
#include <vector>

namespace scanloom
{
/** sensor_msgs/Imu. */
struct ImuMessage
{
  std::string frame;
  ImuSample sample;
};
ImuMessage imuOf(const BagTopic&, Bytes message);

/** A transform of tf2_msgs/TFMessage. */
struct FrameTransform
{
  std::string parent, child;  // frames, without a leading '/'
  Rigid parent_T_child;
};

/** Those whose rotation is not close to a unit quaternion are left out. */
std::vector<FrameTransform> transformsOf(const BagTopic&, Bytes message);

/** Whether poseOf() reads it: nav_msgs/Odometry, geometry_msgs/PoseStamped and PointStamped. */
bool isPoseType(const std::string& type);

/** Of a PointStamped without rotation. */
StampedPose poseOf(const BagTopic&, Bytes message);

/** std_msgs/String. */
std::string textOf(const BagTopic&, Bytes message);
}  // namespace scanloom
