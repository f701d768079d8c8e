#include "input/bags/BagPackets.h"

#include "input/bags/internal/CloudMessage.h"
#include "input/bags/internal/PacketMessages.h"
#include "input/packets/CaptureReader.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

// Messages are a turn long; the slowest lidars make five turns a second.
constexpr Duration kHeldBack = 250ms;
constexpr std::size_t kMostBytesHeld = 64'000'000;

/**
 * When a topic's clouds were received, had none been late: a recorder may hang and then write many at once, and from a
 * file nothing is late. That is the latest point's stamp and the least delay so far.
 */
class Punctual
{
 public:
  Timestamp received(Timestamp message_received, Timestamp latest_point)
  {
    constexpr Duration kOfOneClock = 5s;
    const Duration delay = message_received - latest_point;
    const bool other_clock = least_ && std::chrono::abs(delay - *least_) > kOfOneClock;
    least_ = least_ && !other_clock ? std::min(*least_, delay) : delay;
    return latest_point + *least_;
  }

 private:
  std::optional<Duration> least_;
};

class BagPackets : public DatagramReader
{
 public:
  BagPackets(const Path& path, const std::set<std::string>& topics) : bag_(BagReader::open(path)), topics_(topics)
  {
    const auto& all = bag_->topics();
    if (std::any_of(all.begin(), all.end(), [&](const BagTopic& topic) { return hasClouds(topic); })) lookAhead();
  }

  bool next(Datagram& datagram) override
  {
    while (!isDue())
      if (!readMessage())
      {
        if (held_.empty()) return false;
        break;
      }
    std::pop_heap(held_.begin(), held_.end(), &isLater);
    datagram = std::move(held_.back().datagram);
    held_.pop_back();
    held_bytes_ -= datagram.payload.size();
    ++counters_.datagrams;
    return true;
  }

  CaptureCounters counters() const override { return counters_; }
  double progress() const override { return bag_->progress(); }

 private:
  struct Held
  {
    Datagram datagram;
    std::uint64_t number = 0;  // keeps the order at equal times
  };

  static bool isLater(const Held& a, const Held& b)
  {
    return a.datagram.received != b.datagram.received ? a.datagram.received > b.datagram.received : a.number > b.number;
  }

  /** A message that was read before it is due. */
  struct Ahead
  {
    std::size_t topic = 0;
    Timestamp received;
    std::vector<std::uint8_t> data;  // of a cloud; of others, which are only counted, none
  };

  /** False at the end, which may have been reached ahead. */
  bool readOne(BagMessage& message)
  {
    at_end_ = at_end_ || !bag_->next(message);
    return !at_end_;
  }

  bool hasClouds(const BagTopic& topic) const { return isCloudType(topic.type) && topics_.count(topic.name) > 0; }

  /** Reads the first clouds of each topic ahead, so that the very first is not taken for punctual. */
  void lookAhead()
  {
    constexpr std::size_t kMessages = 1000, kClouds = 20, kBytes = 32'000'000;
    BagMessage message;
    std::size_t clouds = 0, bytes = 0;
    while (ahead_.size() < kMessages && clouds < kClouds && bytes < kBytes && readOne(message))
    {
      Ahead& ahead = ahead_.emplace_back(Ahead{message.topic, message.received, {}});
      const BagTopic& topic = bag_->topics()[message.topic];
      if (!hasClouds(topic)) continue;
      ahead.data.assign(message.data.begin(), message.data.end());
      bytes += message.data.size();
      ++clouds;
      try
      {
        if (const TimedCloud cloud = timedCloudOf(topic, message.data); !cloud.points.empty())
          punctual_[topic.name].received(message.received, cloud.span().second);
      }
      catch (const std::logic_error&)  // counted where it is read
      {
        continue;
      }
    }
  }

  bool isDue() const
  {
    return !held_.empty() && (newest_ - held_.front().datagram.received >= kHeldBack || held_bytes_ > kMostBytesHeld);
  }

  /** False at the end of the bag. */
  bool readMessage()
  {
    for (std::string& warning : bag_->takeWarnings()) counters_.damages.push_back(std::move(warning));
    if (!ahead_.empty())
    {
      const Ahead ahead = std::move(ahead_.front());
      ahead_.pop_front();
      take({ahead.topic, ahead.received, ahead.data});
      return true;
    }
    BagMessage message;
    const bool has_message = readOne(message);
    for (std::string& warning : bag_->takeWarnings()) counters_.damages.push_back(std::move(warning));
    if (has_message) take(message);
    return has_message;
  }

  void take(const BagMessage& message)
  {
    ++counters_.records;
    const BagTopic& topic = bag_->topics()[message.topic];
    if (topics_.count(topic.name) == 0 || !(isPacketType(topic.type) || isCloudType(topic.type)))
      ++counters_.not_udp;
    else
      hold(topic, message);
  }

  void hold(const BagTopic& topic, const BagMessage& message)
  {
    try
    {
      if (isCloudType(topic.type))
      {
        const TimedCloud cloud = timedCloudOf(topic, message.data);
        const std::vector<std::uint8_t> packet = cloudPacket(cloud.points);
        const Timestamp received = cloud.points.empty()
                                       ? message.received
                                       : punctual_[topic.name].received(message.received, cloud.span().second);
        hold({std::nullopt, packet}, topic.name, received);
        return;
      }
      forEachPacket(topic, message.data,
                    [&](const PacketInMessage& packet) { hold(packet, topic.name, message.received); });
    }
    catch (const std::logic_error&)  // a message that ends too early, or can't be read
    {
      ++counters_.malformed;
    }
  }

  void hold(const PacketInMessage& packet, const std::string& topic, Timestamp message_received)
  {
    Held held;
    held.number = ++number_;
    held.datagram.received = packet.stamp.value_or(message_received);
    held.datagram.topic = topic;
    held.datagram.payload.assign(packet.bytes.begin(), packet.bytes.end());
    newest_ = std::max(newest_, held.datagram.received);
    held_bytes_ += held.datagram.payload.size();
    held_.push_back(std::move(held));
    std::push_heap(held_.begin(), held_.end(), &isLater);
  }

  std::unique_ptr<BagReader> bag_;
  std::set<std::string> topics_;  // with packets, or clouds
  std::deque<Ahead> ahead_;
  bool at_end_ = false;
  std::map<std::string, Punctual> punctual_;  // by topic
  std::vector<Held> held_;                    // a heap, the earliest first
  std::size_t held_bytes_ = 0;
  std::uint64_t number_ = 0;
  Timestamp newest_ = Timestamp{};
  CaptureCounters counters_;
};
}  // namespace

std::set<std::string> packetTopicsOf(const std::vector<Path>& recordings)
{
  std::set<std::string> topics, clouds;
  for (const BagTopic& topic : topicsOf(recordings))
  {
    if (isPacketType(topic.type)) topics.insert(topic.name);
    if (isCloudType(topic.type)) clouds.insert(topic.name);
  }
  return topics.empty() ? clouds : topics;
}

std::vector<std::unique_ptr<DatagramReader>> datagramsOf(const std::vector<Path>& recordings)
{
  const std::set<std::string> topics = packetTopicsOf(recordings);
  std::vector<std::unique_ptr<DatagramReader>> readers;
  for (const Path& path : recordings)
    if (isBag(path))
      readers.push_back(std::make_unique<BagPackets>(path, topics));
    else
      readers.push_back(std::make_unique<CaptureReader>(path));
  return readers;
}
}  // namespace scanloom
