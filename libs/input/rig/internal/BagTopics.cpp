#include "input/rig/internal/BagTopics.h"

#include "base/core/ConfigError.h"
#include "input/bags/BagContents.h"
#include "input/bags/BagPackets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Topics = std::set<std::string>;
using RecordingPaths = std::vector<std::filesystem::path>;

std::string listed(const Topics& topics)
{
  return topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "));
}

void refuseUnknown(const std::string& key, const std::string& topic, const Topics& topics)
{
  if (!topic.empty() && topics.count(topic) == 0)
    throw ConfigError(
        fmt::format("{} = {}: no such topic with packets or clouds of a lidar was recorded, or heard; there are: {}",
                    key, topic, listed(topics)));
}

void readMetadata(const RecordingPaths& recordings, RigSensor& lidar)
{
  const std::optional<std::string> topic = topicNamedBy(lidar.options.metadata);
  if (!topic) return;
  try
  {
    lidar.metadata = LidarMetadata{metadataIn(recordings, *topic), lidar.options.metadata};
  }
  catch (const std::invalid_argument& problem)
  {
    throw ConfigError(fmt::format("{}_metadata: {}", lidar.key, problem.what()));
  }
}

/** Topics have no default as ports have. */
std::string onlyTopic(const Topics& topics, const std::string& key)
{
  if (topics.size() != 1)
    throw ConfigError(
        fmt::format("{}_topic is missing: the bag's topics with packets of lidars are: {}", key, listed(topics)));
  return *topics.begin();
}
}  // namespace

void resolveTopics(const RecordingPaths& recordings, std::vector<RigSensor>& lidars)
{
  const bool all_bags =
      !recordings.empty() && std::all_of(recordings.begin(), recordings.end(), [](const auto& p) { return isBag(p); });
  const auto namesTopics = [](const RigSensor& lidar)
  { return !lidar.options.topic.empty() || !lidar.options.imu_topic.empty() || topicNamedBy(lidar.options.metadata); };
  if (!all_bags && std::none_of(lidars.begin(), lidars.end(), namesTopics)) return;

  if (recordings.empty())
    throw ConfigError(
        "the lidars are on topics: give --ros2 to hear them, or name the bag that has them: pcap_input = FILE");
  const Topics topics = packetTopicsOf(recordings);
  for (RigSensor& lidar : lidars)
  {
    refuseUnknown(lidar.key + "_topic", lidar.options.topic, topics);
    refuseUnknown(lidar.key + "_imu_topic", lidar.options.imu_topic, topics);
    if (all_bags && lidar.options.topic.empty()) lidar.options.topic = onlyTopic(topics, lidar.key);
    readMetadata(recordings, lidar);
  }
}

ImuOfEachStamp imuOfTopic(const RecordingPaths& recordings, const std::string& topic)
{
  try
  {
    return readBagImu(recordings, topic);
  }
  catch (const std::invalid_argument& problem)
  {
    throw ConfigError(fmt::format("imu_topic: {}", problem.what()));
  }
}
}  // namespace scanloom
