#include "input/rig/internal/BagTopics.h"

#include "base/core/ConfigError.h"
#include "input/bags/BagContents.h"
#include "input/bags/BagPackets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
using TopicPorts = std::map<std::string, std::uint16_t>;
using RecordingPaths = std::vector<std::filesystem::path>;

std::string topicsAmong(const TopicPorts& ports)
{
  std::vector<std::string> names;
  for (const auto& [topic, port] : ports) names.push_back(topic);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void setPort(const std::string& key, const std::string& topic, const TopicPorts& ports, int& port)
{
  if (topic.empty()) return;
  const auto found = ports.find(topic);
  if (found == ports.end())
    throw ConfigError(
        fmt::format("{} = {}: no bag of pcap_input has such a topic with packets of a lidar; there are: {}", key, topic,
                    topicsAmong(ports)));
  port = found->second;
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
void setOnlyPort(const TopicPorts& ports, RigSensor& lidar)
{
  if (lidar.options.port != 0) return;
  if (ports.size() != 1)
    throw ConfigError(fmt::format("{}_topic is missing: the bag's topics with packets of lidars are: {}", lidar.key,
                                  topicsAmong(ports)));
  lidar.options.port = ports.begin()->second;
}
}  // namespace

void resolveTopics(const RecordingPaths& recordings, std::vector<RigSensor>& lidars)
{
  const bool all_bags =
      !recordings.empty() && std::all_of(recordings.begin(), recordings.end(), [](const auto& p) { return isBag(p); });
  const auto namesTopics = [](const RigSensor& lidar)
  { return !lidar.options.topic.empty() || !lidar.options.imu_topic.empty() || topicNamedBy(lidar.options.metadata); };
  if (!all_bags && std::none_of(lidars.begin(), lidars.end(), namesTopics)) return;

  const TopicPorts ports = portsOfTopics(recordings);
  for (RigSensor& lidar : lidars)
  {
    setPort(lidar.key + "_topic", lidar.options.topic, ports, lidar.options.port);
    setPort(lidar.key + "_imu_topic", lidar.options.imu_topic, ports, lidar.options.imu_port);
    if (all_bags) setOnlyPort(ports, lidar);
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
