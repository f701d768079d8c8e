#pragma once
#include "base/core/ImuSample.h"
#include "input/rig/internal/RigSensor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Of lidars in bags: a topic named by 'metadata' is read, and a lidar without 'topic' gets the only topic with packets
 * (BagPackets.h). Throws ConfigError, naming the topics there are, for a topic that no bag has and for a missing one.
 */
void resolveTopics(const std::vector<std::filesystem::path>& recordings, std::vector<RigSensor>&);

/** Throws ConfigError, naming the topics there are, if no bag has it. */
ImuOfEachStamp imuOfTopic(const std::vector<std::filesystem::path>& recordings, const std::string& topic);
}  // namespace scanloom
