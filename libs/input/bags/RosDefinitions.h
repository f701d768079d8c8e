/** Definitions of the messages that are written, in the language of .msg files. */
#pragma once
#include "input/bags/internal/McapWriter.h"

namespace scanloom
{
McapSchema pointCloudSchema();  // sensor_msgs/msg/PointCloud2
McapSchema imuSchema();         // sensor_msgs/msg/Imu
McapSchema transformsSchema();  // tf2_msgs/msg/TFMessage
McapSchema pathSchema();        // nav_msgs/msg/Path

/** Of a type as ROS 2 writes it; without a definition if it is none of these. */
McapSchema schemaOf(const std::string& type);
}  // namespace scanloom
