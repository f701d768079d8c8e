#include "input/bags/MessagePackets.h"

#include "input/bags/internal/CloudMessage.h"
#include "input/bags/internal/PacketMessages.h"

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Messages are a turn long; the slowest lidars make five turns a second.
constexpr Duration kHeldBack = 250ms;
constexpr std::size_t kMostBytesHeld = 64'000'000;
}  // namespace

bool holdsPackets(const std::string& type) { return isPacketType(type); }
bool holdsClouds(const std::string& type) { return isCloudType(type); }

Timestamp MessagePackets::Punctual::received(Timestamp message_received, Timestamp latest_point)
{
  constexpr Duration kOfOneClock = 5s;
  const Duration delay = message_received - latest_point;
  const bool other_clock = least_ && std::chrono::abs(delay - *least_) > kOfOneClock;
  least_ = least_ && !other_clock ? std::min(*least_, delay) : delay;
  return latest_point + *least_;
}

bool MessagePackets::isLater(const Held& a, const Held& b)
{
  return a.datagram.received != b.datagram.received ? a.datagram.received > b.datagram.received : a.number > b.number;
}

void MessagePackets::take(const BagTopic& topic, const BagMessage& message)
{
  ++counters_.records;
  flushed_ = false;
  if (topics_.count(topic.name) == 0 || !(isPacketType(topic.type) || isCloudType(topic.type)))
  {
    ++counters_.not_udp;
    return;
  }
  looks_ahead_ = looks_ahead_ && isCloudType(topic.type);
  if (!looks_ahead_)
  {
    open(topic, message);
    return;
  }
  lookAt(topic, message);
  if (seesAhead()) takeAhead();
}

/** The first clouds of each topic are read ahead, so that the very first is not taken for punctual. */
void MessagePackets::lookAt(const BagTopic& topic, const BagMessage& message)
{
  try
  {
    if (const TimedCloud cloud = timedCloudOf(topic, message.data); !cloud.points.empty())
      punctual_[topic.name].received(message.received, cloud.span().second);
  }
  catch (const std::logic_error&)  // as in open()
  {
    ++counters_.malformed;
    return;
  }
  ahead_.push_back({topic, message.received, {message.data.begin(), message.data.end()}});
  ahead_bytes_ += message.data.size();
}

bool MessagePackets::seesAhead() const
{
  constexpr std::size_t kClouds = 20, kBytes = 32'000'000;
  return ahead_.size() >= kClouds || ahead_bytes_ >= kBytes;
}

void MessagePackets::takeAhead()
{
  looks_ahead_ = false;
  for (; !ahead_.empty(); ahead_.pop_front())
    open(ahead_.front().topic, {0, ahead_.front().received, ahead_.front().data});
}

bool MessagePackets::isDue() const
{
  return !held_.empty() &&
         (flushed_ || newest_ - held_.front().datagram.received >= kHeldBack || held_bytes_ > kMostBytesHeld);
}

bool MessagePackets::next(Datagram& datagram)
{
  if (flushed_) takeAhead();
  if (!isDue()) return false;
  std::pop_heap(held_.begin(), held_.end(), &isLater);
  datagram = std::move(held_.back().datagram);
  held_.pop_back();
  held_bytes_ -= datagram.payload.size();
  ++counters_.datagrams;
  return true;
}

void MessagePackets::open(const BagTopic& topic, const BagMessage& message)
{
  try
  {
    if (isCloudType(topic.type))
    {
      const TimedCloud cloud = timedCloudOf(topic, message.data);
      const Timestamp received = cloud.points.empty()
                                     ? message.received
                                     : punctual_[topic.name].received(message.received, cloud.span().second);
      hold(cloudPacket(cloud.points), topic.name, received);
      return;
    }
    forEachPacket(topic, message.data,
                  [&](const PacketInMessage& packet)
                  { hold(packet.bytes, topic.name, packet.stamp.value_or(message.received)); });
  }
  catch (const std::logic_error&)  // a message that ends too early, or can't be read
  {
    ++counters_.malformed;
  }
}

void MessagePackets::hold(Bytes packet, const std::string& topic, Timestamp received)
{
  Held held;
  held.number = ++number_;
  held.datagram.received = received;
  held.datagram.topic = topic;
  held.datagram.payload.assign(packet.begin(), packet.end());
  newest_ = std::max(newest_, received);
  held_bytes_ += packet.size();
  held_.push_back(std::move(held));
  std::push_heap(held_.begin(), held_.end(), &isLater);
}
}  // namespace scanloom
