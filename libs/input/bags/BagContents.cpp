#include "input/bags/BagContents.h"

#include "base/core/Statistics.h"
#include "base/core/Text.h"
#include "input/bags/internal/CloudMessage.h"
#include "input/bags/internal/PacketMessages.h"
#include "input/lidar/CloudPacket.h"
#include "input/lidar/LidarModels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr Duration kMetadataUsuallyWithin = 10s;
constexpr std::size_t kCloudsLookedInto = 8;

bool isTextType(const std::string& type) { return type == "std_msgs/String"; }

bool holdsStaticTransforms(const BagTopic& topic)
{
  constexpr std::string_view kName = "tf_static";
  return topic.type == "tf2_msgs/TFMessage" && topic.name.size() >= kName.size() &&
         topic.name.compare(topic.name.size() - kName.size(), kName.size(), kName) == 0;
}

using TakeMessage = std::function<bool(const BagTopic&, const BagMessage&)>;

/** Until `take` returns false, bag after bag. @return the bags' warnings. */
std::vector<std::string> forEachMessage(const BagPaths& paths, const TakeMessage& take)
{
  std::vector<std::string> warnings;
  for (const auto& path : paths)
  {
    if (!isBag(path)) continue;
    const auto bag = BagReader::open(path);
    for (BagMessage message; bag->next(message);)
      if (!take(bag->topics()[message.topic], message)) break;
    for (std::string& warning : bag->takeWarnings()) warnings.push_back(std::move(warning));
  }
  return warnings;
}

class Inventory
{
 public:
  void add(const BagTopic& topic, const BagMessage& message)
  {
    TopicContents& known = topics_[topic.name];
    if (known.messages++ == 0)
    {
      known.name = topic.name;
      known.type = topic.type;
      known.first = known.last = message.received;
    }
    known.first = std::min(known.first, message.received);
    known.last = std::max(known.last, message.received);
    try
    {
      if (isCloudType(topic.type)) lookIntoCloud(topic, message, known);
      lookInto(topic, message.data, known);
    }
    catch (const std::logic_error&)  // it ends too early, or can't be read
    {
      ++contents_.unreadable;
    }
  }

  /** What is in the index only has no messages. */
  void add(const BagTopic& topic)
  {
    TopicContents& known = topics_[topic.name];
    known.name = topic.name;
    known.type = topic.type;
  }

  BagContents finish()
  {
    for (const auto& [topic, clouds] : clouds_)
      if (clouds.stamps.size() > 1) contents_.metadata[topic] = toJson(clouds.metadata());
    for (auto& [name, topic] : topics_) contents_.topics.push_back(std::move(topic));
    return std::move(contents_);
  }

 private:
  /** The first clouds of a topic. */
  struct Clouds
  {
    std::vector<Timestamp> stamps;  // of their earliest points
    int channels = 1;

    /** By stamps: clouds may be received late, all at once, or twice. */
    CloudMetadata metadata() const
    {
      std::vector<Timestamp> sorted = stamps;
      std::sort(sorted.begin(), sorted.end());
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      if (sorted.size() < 2) return {CloudMetadata{}.rate, channels};
      std::vector<Duration> steps;
      for (std::size_t i = 1; i < sorted.size(); ++i) steps.push_back(sorted[i] - sorted[i - 1]);
      const double step = seconds(upperMedian(std::move(steps)));
      return {step > 0 ? std::round(10 / step) / 10 : CloudMetadata{}.rate, channels};
    }
  };

  void lookIntoCloud(const BagTopic& topic, const BagMessage& message, TopicContents& known)
  {
    Clouds& clouds = clouds_[topic.name];
    if (clouds.stamps.size() >= kCloudsLookedInto) return;
    try
    {
      const TimedCloud cloud = timedCloudOf(topic, message.data);
      clouds.stamps.push_back(cloud.points.empty() ? message.received : cloud.span().first);
      clouds.channels = std::max(clouds.channels, cloud.channels);
      known.frame = cloud.frame;
      known.note = cloud.time_is;
      known.one_instant = cloud.one_instant;
    }
    catch (const std::invalid_argument& no_time)
    {
      if (clouds.stamps.empty()) known.note = no_time.what();
    }
  }

  void lookInto(const BagTopic& topic, Bytes data, TopicContents& known)
  {
    if (holdsStaticTransforms(topic))
      for (const FrameTransform& transform : transformsOf(topic, data)) contents_.frames.add(transform);
    if (isTextType(topic.type) && contents_.metadata.count(topic.name) == 0)
      if (std::string text = textOf(topic, data); isLidarMetadata(text)) contents_.metadata[topic.name] = text;
    if (!known.frame.empty()) return;
    if (isPacketType(topic.type)) known.frame = frameOfPackets(topic, data);
    if (isImuType(topic.type)) known.frame = imuOf(topic, data).frame;
  }

  std::map<std::string, TopicContents> topics_;
  std::map<std::string, Clouds> clouds_;  // by topic
  BagContents contents_;
};

template <typename Value>
struct TopicValues
{
  std::vector<Value> values;
  std::size_t unreadable = 0;  // messages that end too early, or are not understood
};

/** The messages of a topic as values, in order of stamps. */
template <typename Value>
TopicValues<Value> valuesOf(const BagPaths& paths, const std::string& name, bool (*isWanted)(const std::string&),
                            Value (*valueOf)(const BagTopic&, Bytes), const char* what)
{
  TopicValues<Value> found;
  std::vector<std::string> possible;
  for (const BagTopic& topic : topicsOf(paths))
    if (isWanted(topic.type)) possible.push_back(topic.name);
  if (std::find(possible.begin(), possible.end(), name) == possible.end())
    throw std::invalid_argument(
        fmt::format("{}; topics with {}: {}",
                    name.empty() ? "no topic is named" : fmt::format("the bag has no topic '{}' with {}", name, what),
                    what, possible.empty() ? "none" : fmt::format("{}", fmt::join(possible, ", "))));
  std::string not_understood;  // of the first such message
  forEachMessage(paths,
                 [&](const BagTopic& topic, const BagMessage& message)
                 {
                   if (topic.name != name || !isWanted(topic.type)) return true;
                   try
                   {
                     found.values.push_back(valueOf(topic, message.data));
                   }
                   catch (const std::out_of_range&)
                   {
                     ++found.unreadable;
                   }
                   catch (const std::invalid_argument& reason)
                   {
                     ++found.unreadable;
                     if (not_understood.empty()) not_understood = reason.what();
                   }
                   return true;
                 });
  if (found.values.empty() && !not_understood.empty()) throw std::invalid_argument(not_understood);
  const auto earlier = [](const Value& a, const Value& b) { return a.stamp < b.stamp; };
  std::stable_sort(found.values.begin(), found.values.end(), earlier);
  return found;
}

ImuSample imuSampleOf(const BagTopic& topic, Bytes message) { return imuOf(topic, message).sample; }
}  // namespace

bool isImuType(const std::string& type) { return type == "sensor_msgs/Imu"; }

std::vector<TopicContents> BagContents::ofType(bool (*isWanted)(const std::string&)) const
{
  std::vector<TopicContents> found;
  std::copy_if(topics.begin(), topics.end(), std::back_inserter(found),
               [&](const TopicContents& topic) { return isWanted(topic.type); });
  return found;
}

BagContents contentsOf(const BagPaths& paths, Duration longest)
{
  Inventory inventory;
  for (const BagTopic& topic : topicsOf(paths)) inventory.add(topic);
  std::optional<Timestamp> first;
  auto warnings = forEachMessage(paths,
                                 [&](const BagTopic& topic, const BagMessage& message)
                                 {
                                   if (!first) first = message.received;
                                   if (message.received - *first > longest) return false;
                                   inventory.add(topic, message);
                                   return true;
                                 });
  BagContents contents = inventory.finish();
  contents.warnings = std::move(warnings);
  if (const auto circling = contents.frames.inCircles(); !circling.empty())
    contents.warnings.push_back(fmt::format("tf_static goes in a circle, so these frames have no pose: {}",
                                            printable(fmt::format("{}", fmt::join(circling, ", ")))));
  return contents;
}

std::string metadataIn(const BagPaths& paths, const std::string& name)
{
  std::vector<std::string> possible;
  for (const Duration within : {Duration{kMetadataUsuallyWithin}, Duration::max()})
  {
    const BagContents contents = contentsOf(paths, within);
    if (const auto found = contents.metadata.find(name); found != contents.metadata.end()) return found->second;
    possible.clear();
    for (const auto& [topic, text] : contents.metadata) possible.push_back(topic);
  }
  throw std::invalid_argument(fmt::format(
      "topic:{}: no lidar's metadata (std_msgs/String) or timed clouds were recorded or heard there; some are on: {}",
      name, possible.empty() ? "none" : fmt::format("{}", fmt::join(possible, ", "))));
}

ImuOfEachStamp readBagImu(const BagPaths& paths, const std::string& topic)
{
  const auto found = valuesOf(paths, topic, &isImuType, &imuSampleOf, "sensor_msgs/Imu");
  ImuOfEachStamp imu = oneOfEachStamp(found.values);
  imu.unreadable = found.unreadable;
  return imu;
}

std::optional<ImuSample> imuSampleIn(const BagTopic& topic, Bytes message)
try
{
  return imuSampleOf(topic, message);
}
catch (const std::logic_error&)
{
  return std::nullopt;
}

BagPoses readBagPoses(const BagPaths& paths, const std::string& topic)
{
  std::set<std::string> names;
  std::string type;
  for (const BagTopic& known : topicsOf(paths))
  {
    if (!isPoseType(known.type)) continue;
    names.insert(known.name);
    if (topic.empty() || known.name == topic) type = known.type;
  }
  const std::string name = topic.empty() && names.size() == 1 ? *names.begin() : topic;
  auto [poses, unreadable] = valuesOf(paths, name, &isPoseType, &poseOf, "poses");
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.stamp == b.stamp; };
  poses.erase(std::unique(poses.begin(), poses.end(), same), poses.end());
  return {std::move(poses), type != "geometry_msgs/PointStamped", unreadable};
}
}  // namespace scanloom
