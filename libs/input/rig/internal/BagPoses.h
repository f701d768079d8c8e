/** Where a bag's lidars and IMU are on the body, by its static transforms. */
#pragma once
#include "input/bags/BagContents.h"
#include "input/rig/FoundLidars.h"

#include <map>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * "T_body_<name>" of the lidars, and "T_body_imu", as an extrinsics file has them; without those whose frame is not
 * known. The body is the frame base_link, else the one above all others.
 */
std::map<std::string, Rigid> posesByFrames(const BagContents&, const std::vector<FoundLidar>&,
                                           const std::vector<std::string>& names, const std::string& imu_topic);

/**
 * The topic of the body's IMU: of those whose frame is known, else of all, the one with the most samples; empty if
 * there is none. A driver may publish what a lidar's IMU packets hold: that is not the body's.
 */
std::string bodyImuTopic(const BagContents&, const std::vector<FoundLidar>&);
}  // namespace scanloom
