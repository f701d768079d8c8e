#include "input/bags/internal/RawlogBag.h"

#include "input/bags/MessageWriter.h"
#include "input/rawlogs/PacketRawlog.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kEverySensorAppearsWithin = 10s;
const BagTopic kStaticTransforms{"/tf_static", "tf2_msgs/TFMessage", Serialisation::Cdr};

Timestamp timeOf(const RawlogMeasurement& measurement)
{
  const auto* turn = std::get_if<VelodyneTurn>(&measurement.value);
  return bagStamp(nanoseconds(turn ? turn->packets.front().received : std::get<ImuSample>(measurement.value).stamp));
}

BagTopic topicOf(const RawlogMeasurement& measurement)
{
  const bool is_turn = std::holds_alternative<VelodyneTurn>(measurement.value);
  const std::string name = measurement.label.empty() ? (is_turn ? "lidar" : "imu") : measurement.label;
  return declaredTopic(name, is_turn ? "velodyne_msgs/VelodyneScan" : "sensor_msgs/Imu", Serialisation::Cdr);
}

bool isSame(const BagTopic& a, const BagTopic& b) { return a.name == b.name && a.type == b.type; }

std::vector<BagTopic> firstTopicsOf(const std::filesystem::path& path)
{
  std::vector<BagTopic> topics{kStaticTransforms};
  PacketRawlog rawlog(path);
  std::optional<Timestamp> first;
  for (RawlogMeasurement measurement; rawlog.next(measurement);)
  {
    if (!first) first = timeOf(measurement);
    if (timeOf(measurement) - *first > kEverySensorAppearsWithin) break;
    const BagTopic topic = topicOf(measurement);
    if (std::none_of(topics.begin(), topics.end(), [&](const BagTopic& known) { return isSame(known, topic); }))
      topics.push_back(topic);
  }
  return topics;
}

/** velodyne_msgs/VelodyneScan */
std::vector<std::uint8_t> messageOf(const VelodyneTurn& turn, const std::string& frame)
{
  MessageWriter message;
  message.header(turn.packets.front().received, frame);
  message.number(static_cast<std::uint32_t>(turn.packets.size()));
  for (const VelodyneTurn::Packet& packet : turn.packets)
  {
    message.time(packet.received);
    message.byteArray(packet.bytes);
  }
  return message.bytes();
}

std::vector<std::uint8_t> messageOf(const RawlogMeasurement& measurement, const std::string& frame)
{
  const auto* turn = std::get_if<VelodyneTurn>(&measurement.value);
  return turn ? messageOf(*turn, frame) : imuMessage(std::get<ImuSample>(measurement.value), frame);
}

class RawlogBag : public BagReader
{
 public:
  explicit RawlogBag(const std::filesystem::path& path)
    : path_(path), file_bytes_(std::filesystem::file_size(path)), topics_(firstTopicsOf(path)), rawlog_(path)
  {
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }

  bool next(BagMessage& message) override
  {
    while (waiting_.empty())
      if (!readMeasurement()) return false;
    current_ = std::move(waiting_.front());
    waiting_.pop_front();
    message = {current_.topic, current_.received, current_.bytes};
    return true;
  }

  std::vector<std::string> takeWarnings() override { return std::exchange(warnings_, {}); }

  double progress() const override
  {
    return std::min(1.0, static_cast<double>(rawlog_.bytesRead()) / static_cast<double>(file_bytes_));
  }

 private:
  struct Message
  {
    std::size_t topic = 0;
    Timestamp received;
    std::vector<std::uint8_t> bytes;
  };

  /** False at the end. */
  bool readMeasurement()
  {
    RawlogMeasurement measurement;
    if (!rawlog_.next(measurement))
    {
      if (!rawlog_.damage().empty() && !std::exchange(damage_is_reported_, true))
        warnings_.push_back(fmt::format("{}: {}", path_.string(), rawlog_.damage()));
      return false;
    }
    const BagTopic topic = topicOf(measurement);
    const auto known =
        std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& t) { return isSame(t, topic); });
    if (known == topics_.end())
    {
      if (late_.insert(topic.name).second)
        warnings_.push_back(fmt::format("{}: '{}' begins more than {} s after the first object: left out",
                                        path_.string(), topic.name, kEverySensorAppearsWithin / 1s));
      return true;
    }
    const Timestamp received = timeOf(measurement);
    if (placed_.insert(topic.name).second)
      waiting_.push_back(
          {0, received, transformsMessage({{received, "base_link", topic.name, measurement.body_T_sensor}})});
    const auto place = static_cast<std::size_t>(known - topics_.begin());
    waiting_.push_back({place, received, messageOf(measurement, topic.name)});
    return true;
  }

  std::filesystem::path path_;
  std::uint64_t file_bytes_;
  std::vector<BagTopic> topics_;
  PacketRawlog rawlog_;
  std::deque<Message> waiting_;
  Message current_;
  std::set<std::string> placed_, late_;  // topics whose transform was given, that were left out
  bool damage_is_reported_ = false;
  std::vector<std::string> warnings_;
};
}  // namespace

std::unique_ptr<BagReader> openRawlogBag(const std::filesystem::path& path)
{
  return std::make_unique<RawlogBag>(path);
}
}  // namespace scanloom
