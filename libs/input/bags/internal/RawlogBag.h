#pragma once
#include "input/bags/BagReader.h"

namespace scanloom
{
/**
 * A rawlog of stock MRPT with packets of lidars, as a bag of ROS 2: a topic per label, with velodyne_msgs/VelodyneScan
 * or sensor_msgs/Imu, and /tf_static with the sensors' poses below base_link. Labels that first appear more than
 * 10 s after the first one are left out, with a warning. Throws std::runtime_error if it can't be opened.
 */
std::unique_ptr<BagReader> openRawlogBag(const std::filesystem::path&);
}  // namespace scanloom
