#include "input/rig/internal/RigTopics.h"

#include "base/core/ConfigError.h"
#include "input/bags/BagContents.h"
#include "input/rig/internal/LiveCapture.h"
#include "input/rig/internal/eventLimits.h"

#include <fmt/format.h>
#include <pthread.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr auto kAccountPeriod = 100ms;
constexpr auto kSilence = 1s;  // after which nothing is waited for any more: drivers send ten times as often
constexpr std::size_t kWarningsKept = 1000;  // if nobody takes them

std::set<std::string> topicsOf(const Rig& rig)
{
  std::set<std::string> topics;
  for (const LidarAddress& address : rig.addresses)
    for (const std::string& topic : {address.topic, address.imu_topic})
      if (!topic.empty()) topics.insert(topic);
  return topics;
}

std::unique_ptr<TopicRecording> recordingOf(const Rig& rig)
{
  const std::filesystem::path& file = rig.live.capture;
  if (file.empty()) return nullptr;
  if (file.extension() != ".mcap")
    throw ConfigError(
        fmt::format("pcap_output = {}: topics are recorded in an MCAP: name a file .mcap", file.string()));
  return std::make_unique<TopicRecording>(newCapture(file));
}
}  // namespace

RigTopics::RigTopics(const Rig& rig)
  : setup_(setupOf(rig)),
    node_(rig.live.ros2),
    imu_topic_(rig.body_imu_topic),
    stream_(rig, RigStream::ReceiveTimes::OfCapture),  // as a replay takes them
    packets_(topicsOf(rig)),
    queue_(eventLimits(rig), [](const SensorEvent& event) { return event.index(); }),
    recording_(recordingOf(rig)),
    heard_(Clock::now()),
    account_(stream_.account())
{
  std::set<std::string> topics = topicsOf(rig);
  if (!imu_topic_.empty()) topics.insert(imu_topic_);
  if (recording_)  // what describes the sensors is of use to its replay alone
  {
    topics.insert("/tf_static");
    for (const RigSensor& sensor : rig.sensors)
      if (const auto topic = topicNamedBy(sensor.options.metadata)) topics.insert(*topic);
  }
  for (const std::string& topic : topics) node_->subscribe(topic);
  thread_ = std::thread([this] { receive(); });
  ::pthread_setname_np(thread_.native_handle(), "scanloom-topics");
}

RigTopics::~RigTopics()
{
  stop();
  thread_.join();
}

void RigTopics::receive()
{
  std::exception_ptr error;
  try
  {
    for (Clock::time_point published = Clock::now(); !stop_;)
    {
      receiveOne();
      if (Clock::now() - published < kAccountPeriod) continue;
      publish();
      published = Clock::now();
    }
    packets_.flush();
    takePackets();
    stream_.finish();
    while (std::optional<SensorEvent> event = stream_.next()) queue_.pushDroppingOldest(*std::move(event));
    closeRecording();
  }
  catch (...)
  {
    error = std::current_exception();
  }
  publish();
  queue_.end(error);
}

/** The scans were given out: a full disk does not make them wrong. */
void RigTopics::closeRecording()
{
  if (!recording_) return;
  try
  {
    recording_->close();
  }
  catch (const std::exception& failure)
  {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(fmt::format("{}: not all that was heard is recorded", failure.what()));
  }
}

void RigTopics::receiveOne()
{
  if (const std::optional<Ros2Message> message = node_->next(kAccountPeriod))
  {
    heard_ = Clock::now();
    if (recording_) recording_->add(*message);
    take(*message);
  }
  else if (Clock::now() - heard_ > kSilence)
    packets_.flush();
  takePackets();
}

void RigTopics::take(const Ros2Message& message)
{
  const auto key = std::pair{message.topic.name, message.topic.type};
  auto topic = topics_.find(key);
  if (topic == topics_.end())
    topic = topics_.emplace(key, declaredTopic(message.topic.name, message.topic.type, Serialisation::Cdr)).first;
  if (message.topic.name != imu_topic_)
  {
    packets_.take(topic->second, {0, message.received, message.data});
    return;
  }
  const std::optional<ImuSample> sample = imuSampleIn(topic->second, message.data);
  if (!sample)
    ++unreadable_imu_;
  else if (sample->stamp > newest_imu_)
  {
    newest_imu_ = sample->stamp;
    stream_.takeBodyImu({*sample});
  }
}

void RigTopics::takePackets()
{
  for (Datagram datagram; packets_.next(datagram);) stream_.take(datagram);
  while (std::optional<SensorEvent> event = stream_.next()) queue_.pushDroppingOldest(*std::move(event));
}

void RigTopics::publish()
{
  RigAccount account = stream_.account();
  const CaptureCounters& packets = packets_.counters();
  const Ros2Losses losses = node_->losses();
  account.input["messages"] = packets.records;
  account.input["messages_malformed"] = packets.malformed + unreadable_imu_;
  account.input["messages_dropped"] = losses.dropped;
  account.input["messages_lost"] = losses.lost;
  std::vector<std::string> warnings = stream_.takeWarnings();
  const std::lock_guard lock(mutex_);
  account_ = std::move(account);
  for (std::string& warning : warnings)
    if (warnings_.size() < kWarningsKept) warnings_.push_back(std::move(warning));
}

RigAccount RigTopics::account() const
{
  RigAccount account;
  {
    const std::lock_guard lock(mutex_);
    account = account_;
  }
  addQueueCounts(queue_, account);
  return account;
}

std::vector<std::string> RigTopics::takeWarnings()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(warnings_, {});
}
}  // namespace scanloom
