/** Messages of topics in an MCAP, which BagReader reads as it reads those of `ros2 bag record`. */
#pragma once
#include "base/core/OutputFile.h"
#include "input/bags/RosDefinitions.h"
#include "input/ros2/Ros2Node.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace scanloom
{
/** Whether a topic of this type tells of lidars, IMUs or poses: packets, clouds, metadata, transforms. */
bool isOfSensors(const Ros2Topic&);

class TopicRecording
{
 public:
  /** Throws std::runtime_error if the file cannot be created. */
  explicit TopicRecording(const std::filesystem::path&);

  void add(const Ros2Message&);

  /** Nothing may follow. Throws std::runtime_error if the disk did not take all of it. */
  void close();

 private:
  OutputFile file_;
  McapWriter writer_;
  std::map<std::pair<std::string, std::string>, std::uint16_t> topics_;  // by name and type
};

/**
 * Records all topics of sensors that others publish, for this long from the first message on, but not more than 400 MB;
 * less if `keepOn` says so, or if no message comes within six seconds.
 * The node has no subscriptions afterwards. @return the number of messages. Throws as TopicRecording does.
 */
std::uint64_t recordTopics(Ros2Node&, Duration, const std::filesystem::path&, const std::function<bool()>& keepOn);
}  // namespace scanloom
