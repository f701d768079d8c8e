#include "input/ros2/TopicRecording.h"

#include "base/core/Text.h"
#include "input/bags/BagContents.h"
#include "input/bags/MessagePackets.h"

#include <chrono>
#include <optional>
#include <set>

namespace scanloom
{
bool isOfSensors(const Ros2Topic& topic)
{
  const std::string type = typeNameOf(topic.type);
  return holdsPackets(type) || holdsClouds(type) || isImuType(type) || type == "std_msgs/String" ||
         (type == "tf2_msgs/TFMessage" && endsWith(topic.name, "tf_static"));
}

TopicRecording::TopicRecording(const std::filesystem::path& path) : file_(path), writer_(file_.stream()) {}

void TopicRecording::add(const Ros2Message& message)
{
  const auto key = std::pair{message.topic.name, message.topic.type};
  auto known = topics_.find(key);
  if (known == topics_.end())
    known = topics_.emplace(key, writer_.addTopic(message.topic.name, schemaOf(message.topic.type))).first;
  writer_.add(known->second, message.received, message.data);
}

void TopicRecording::close()
{
  writer_.close();
  file_.commit();
}

std::uint64_t recordTopics(Ros2Node& node, Duration longest, const std::filesystem::path& path,
                           const std::function<bool()>& keepOn)
{
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kMostBytes = 400'000'000;
  // Fast DDS 3.1 (Debian 13) tells of itself three seconds after its start, and of its topics two seconds later.
  constexpr Duration kDiscovery = 6s;
  TopicRecording recording(path);
  std::set<std::string> subscribed;
  std::uint64_t messages = 0;
  std::size_t bytes = 0;
  const auto start = Clock::now();
  std::optional<Clock::time_point> first;
  const auto lasts = [&] { return first ? Clock::now() - *first < longest : Clock::now() - start < kDiscovery; };
  while (lasts() && bytes < kMostBytes && keepOn())
  {
    for (const Ros2Publication& publication : node.publications())
      if (isOfSensors(publication.topic) && subscribed.insert(publication.topic.name).second)
        node.subscribe(publication.topic.name);
    const std::optional<Ros2Message> message = node.next(50ms);
    if (!message) continue;
    if (!first) first = Clock::now();
    recording.add(*message);
    bytes += message->data.size();
    ++messages;
  }
  node.unsubscribe();
  recording.close();
  return messages;
}
}  // namespace scanloom
