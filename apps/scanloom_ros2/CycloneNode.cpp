/** libscanloom_dds.so: what libs/input/ros2/Ros2Node.h promises, by Cyclone DDS. */
#include "RawMessages.h"
#include "base/core/Text.h"
#include "cycloneConfiguration.h"
#include "input/ros2/Ros2Node.h"
#include "nodeMessage.h"

#include <dds/dds.h>
#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace scanloom
{
namespace
{
using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
using Steady = std::chrono::steady_clock;

constexpr std::size_t kMemory = 256'000'000;  // bytes of messages that wait: two seconds of eight lidars
constexpr int kKeptByReaders = 4000;          // messages between two looks at a topic: three seconds of its packets

/** Throws std::runtime_error for the codes of Cyclone's errors. */
dds_entity_t checked(dds_entity_t result, const std::string& what)
{
  if (result < 0) throw std::runtime_error(fmt::format("ROS 2 (DDS): {}: {}", what, dds_strretcode(result)));
  return result;
}

/** What Cyclone warns of. Any sender of the network can cause a line for each packet: a person sees the first few. */
void logToPerson(void*, const dds_log_data_t* line)
{
  constexpr int kShown = 5;
  constexpr std::size_t kLongest = 200;  // characters
  static std::atomic<int> number{0};
  const int n = ++number;
  if (n > kShown) return;
  const std::string_view text(line->message, std::min(line->size, kLongest));
  fmt::print(stderr, "warning: ROS 2 (DDS): {}{}\n", printable(std::string(trimmed(text))),
             n == kShown ? " (no more of these are shown)" : "");
}

Qos newQos() { return {dds_create_qos(), &dds_delete_qos}; }

Qos qosOf(bool reliable, bool for_latecomers, int messages)
{
  Qos qos = newQos();
  dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), for_latecomers ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, messages);
  if (for_latecomers)
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, messages, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

class CycloneNode : public Ros2Node
{
 public:
  CycloneNode(const Ros2Network& network, std::string name_space, std::string name)
    : long_ids_(network.long_ids), name_space_(std::move(name_space)), name_(std::move(name))
  {
    const auto domain = static_cast<dds_domainid_t>(network.domain);
    dds_set_log_sink(&logToPerson, nullptr);
    domain_ =
        checked(dds_create_domain(domain, configurationOf(network).c_str()), "no network, or a wrong CYCLONEDDS_URI");
    try
    {
      const Qos qos = newQos();
      constexpr std::string_view kEnclave = "enclave=/;";  // by which nodes of ROS 2 know each other
      dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
      participant_ = checked(dds_create_participant(domain, qos.get(), nullptr), "no participant");
      discovery_ =
          checked(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr), "no discovery");
      nodes_ = createWriter("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", {1, true});
      dds_set_status_mask(discovery_, DDS_DATA_AVAILABLE_STATUS);
      waitset_ = checked(dds_create_waitset(participant_), "no waitset");
      stop_ = checked(dds_create_guardcondition(participant_), "no guard condition");
      attach(discovery_);
      attach(stop_);
      introduce();
    }
    catch (...)
    {
      dds_delete(domain_);
      throw;
    }
    thread_ = std::thread([this] { receive(); });
    ::pthread_setname_np(thread_.native_handle(), "scanloom-ros2");
  }

  CycloneNode(const CycloneNode&) = delete;
  CycloneNode& operator=(const CycloneNode&) = delete;

  ~CycloneNode() override
  {
    dds_set_guardcondition(stop_, true);
    thread_.join();
    dds_delete(domain_);
  }

  std::vector<Ros2Publication> publications() const override
  {
    const std::lock_guard lock(mutex_);
    std::vector<Ros2Publication> found;
    for (const auto& [key, publisher] : publishers_)
    {
      const auto same = [&p = publisher](const Ros2Publication& known) { return known.topic == p.topic; };
      auto known = std::find_if(found.begin(), found.end(), same);
      if (known == found.end()) known = found.insert(found.end(), {publisher.topic});
      ++known->publishers;
      known->reliable &= publisher.reliable;
      known->kept_for_latecomers &= publisher.for_latecomers;
    }
    std::sort(found.begin(), found.end(),
              [](const Ros2Publication& a, const Ros2Publication& b)
              { return std::tie(a.topic.name, a.topic.type) < std::tie(b.topic.name, b.topic.type); });
    return found;
  }

  void subscribe(const std::string& topic) override
  {
    const std::lock_guard lock(mutex_);
    wanted_.push_back(topic);
    followPublishers();
  }

  void unsubscribe() override
  {
    const std::lock_guard lock(mutex_);
    wanted_.clear();
    while (!readers_.empty()) removeReader(std::prev(readers_.end()));
    introduce();
    const std::lock_guard queue_lock(queue_mutex_);
    queue_.clear();
    waiting_ = 0;
  }

  std::optional<Ros2Message> next(Duration patience) override
  {
    std::unique_lock lock(queue_mutex_);
    arrived_.wait_for(lock, patience, [this] { return !queue_.empty(); });
    if (queue_.empty()) return std::nullopt;
    std::optional<Ros2Message> message(std::move(queue_.front()));
    queue_.pop_front();
    waiting_ -= message->data.size();
    return message;
  }

  Ros2Losses losses() const override
  {
    const std::lock_guard lock(mutex_);
    Ros2Losses losses{dropped_, lost_};
    for (const Reader& reader : readers_)
    {
      dds_sample_lost_status_t status{};
      if (dds_get_sample_lost_status(reader.entity, &status) == DDS_RETCODE_OK) losses.lost += status.total_count;
    }
    return losses;
  }

  std::size_t advertise(const Ros2Topic& topic, const Ros2Keep& keep) override
  {
    const std::lock_guard lock(mutex_);
    writers_.push_back(createWriter(ddsTopicOf(topic.name), ddsTypeOf(topic.type), keep));
    introduce();
    return writers_.size() - 1;
  }

  bool publish(std::size_t topic, std::vector<std::uint8_t> message) override
  {
    return write(writer(topic), std::move(message));
  }

  bool hasReaders(std::size_t topic) const override
  {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer(topic).entity, &status);
    return status.current_count > 0;
  }

 private:
  struct Publisher
  {
    Ros2Topic topic;
    bool reliable = true, for_latecomers = false;
  };

  struct Reader
  {
    Ros2Topic topic;
    bool reliable = true, for_latecomers = false;
    dds_entity_t entity = 0;
  };

  struct Writer
  {
    dds_entity_t entity = 0;
    const ddsi_sertype* type = nullptr;  // of its topic, as long as that is there
  };

  dds_entity_t createTopic(const std::string& dds_name, ddsi_sertype** type) const
  {
    // It is Cyclone's then, which replaces it by an equal one that it knows already.
    return checked(dds_create_topic_sertype(participant_, dds_name.c_str(), type, nullptr, nullptr, nullptr),
                   "no topic " + dds_name);
  }

  Writer createWriter(const std::string& dds_name, const std::string& dds_type, const Ros2Keep& keep) const
  {
    ddsi_sertype* type = rawType(dds_type);
    const dds_entity_t topic = createTopic(dds_name, &type);
    const Qos qos = qosOf(true, keep.for_latecomers, keep.messages);
    return {checked(dds_create_writer(participant_, topic, qos.get(), nullptr), "no writer of " + dds_name), type};
  }

  const Writer& writer(std::size_t topic) const
  {
    const std::lock_guard lock(mutex_);
    return writers_.at(topic);
  }

  static bool write(const Writer& writer, std::vector<std::uint8_t> message)
  {
    return dds_writecdr(writer.entity, rawMessage(writer.type, std::move(message))) == DDS_RETCODE_OK;
  }

  static Guid guidOf(dds_entity_t entity)
  {
    dds_guid_t guid{};
    checked(dds_get_guid(entity, &guid), "an entity without identifier");
    Guid bytes;
    std::copy(std::begin(guid.v), std::end(guid.v), bytes.begin());
    return bytes;
  }

  /** Tells the other nodes what this one reads and writes. */
  void introduce() const
  {
    std::vector<Guid> readers, writers;
    for (const Reader& reader : readers_) readers.push_back(guidOf(reader.entity));
    for (const Writer& writer : writers_) writers.push_back(guidOf(writer.entity));
    write(nodes_, nodeMessage(long_ids_, name_space_, name_, guidOf(participant_), readers, writers));
  }

  void attach(dds_entity_t entity) const
  {
    checked(dds_waitset_attach(waitset_, entity, entity), "nothing to wait for");
  }

  void receive()
  {
    while (true)
    {
      std::array<dds_attach_t, 64> ready{};
      const dds_return_t count = dds_waitset_wait(waitset_, ready.data(), ready.size(), DDS_SECS(1));
      const auto end = ready.begin() + std::clamp<dds_return_t>(count, 0, ready.size());
      if (std::find(ready.begin(), end, stop_) != end) return;
      if (std::find(ready.begin(), end, discovery_) != end) discover();
      takeMessages();
    }
  }

  void discover()
  {
    constexpr std::size_t kAtOnce = 16;
    const std::lock_guard lock(mutex_);
    std::array<void*, kAtOnce> samples{};
    std::array<dds_sample_info_t, kAtOnce> infos;
    for (int count = 1; count > 0;)
    {
      count = dds_take(discovery_, samples.data(), infos.data(), kAtOnce, kAtOnce);
      for (int i = 0; i < count; ++i) follow(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]), infos[i]);
      if (count > 0) dds_return_loan(discovery_, samples.data(), count);
    }
    followPublishers();
  }

  void follow(const dds_builtintopic_endpoint_t& endpoint, const dds_sample_info_t& info)
  {
    Guid key;
    std::copy(std::begin(endpoint.key.v), std::end(endpoint.key.v), key.begin());
    if (info.instance_state != DDS_ALIVE_INSTANCE_STATE)
    {
      publishers_.erase(key);
      return;
    }
    dds_guid_t own{};
    dds_get_guid(participant_, &own);
    const auto topic =
        endpoint.topic_name && endpoint.type_name ? rosTopicOf(endpoint.topic_name, endpoint.type_name) : std::nullopt;
    constexpr std::size_t kMostPublishers = 10'000;  // an unknown sender may announce without end
    const bool is_own = std::memcmp(own.v, endpoint.participant_key.v, sizeof own.v) == 0;
    if (!topic || is_own || publishers_.size() >= kMostPublishers) return;
    Publisher publisher{*topic};
    dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
    dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
    dds_duration_t blocking = 0;
    dds_qget_reliability(endpoint.qos, &reliability, &blocking);
    dds_qget_durability(endpoint.qos, &durability);
    publisher.reliable = reliability == DDS_RELIABILITY_RELIABLE;
    publisher.for_latecomers = durability != DDS_DURABILITY_VOLATILE;
    publishers_[key] = std::move(publisher);
  }

  /** A reader for each type of a wanted topic, which asks for no more than all of its publishers offer. */
  void followPublishers()
  {
    bool changed = false;
    std::map<std::pair<std::string, std::string>, Publisher> offers;  // by name and type
    for (const auto& [key, publisher] : publishers_)
    {
      if (std::find(wanted_.begin(), wanted_.end(), publisher.topic.name) == wanted_.end()) continue;
      const auto [offer, first] = offers.emplace(std::pair{publisher.topic.name, publisher.topic.type}, publisher);
      offer->second.reliable &= publisher.reliable;
      offer->second.for_latecomers &= publisher.for_latecomers;
    }
    for (const auto& [name_and_type, offer] : offers)
    {
      const auto reads = [&o = offer](const Reader& reader) { return reader.topic == o.topic; };
      const auto known = std::find_if(readers_.begin(), readers_.end(), reads);
      const bool fits = known != readers_.end() && (offer.reliable || !known->reliable) &&
                        (offer.for_latecomers || !known->for_latecomers);
      if (fits) continue;
      if (known != readers_.end()) removeReader(known);
      addReader(offer);
      changed = true;
    }
    if (changed) introduce();
  }

  void addReader(const Publisher& offer)
  {
    ddsi_sertype* type = rawType(ddsTypeOf(offer.topic.type));
    const dds_entity_t topic = createTopic(ddsTopicOf(offer.topic.name), &type);
    const Qos qos = qosOf(offer.reliable, offer.for_latecomers, kKeptByReaders);
    Reader reader{offer.topic, offer.reliable, offer.for_latecomers};
    reader.entity =
        checked(dds_create_reader(participant_, topic, qos.get(), nullptr), "no reader of " + offer.topic.name);
    dds_set_status_mask(reader.entity, DDS_DATA_AVAILABLE_STATUS);
    attach(reader.entity);
    readers_.push_back(std::move(reader));
  }

  void removeReader(std::vector<Reader>::iterator reader)
  {
    dds_sample_lost_status_t status{};
    if (dds_get_sample_lost_status(reader->entity, &status) == DDS_RETCODE_OK) lost_ += status.total_count;
    dds_delete(reader->entity);
    readers_.erase(reader);
  }

  void takeMessages()
  {
    const std::lock_guard lock(mutex_);
    for (const Reader& reader : readers_) takeFrom(reader);
  }

  void takeFrom(const Reader& reader)
  {
    constexpr std::uint32_t kAtOnce = 32;
    std::array<ddsi_serdata*, kAtOnce> messages{};
    std::array<dds_sample_info_t, kAtOnce> infos;
    for (int count = kAtOnce; count == static_cast<int>(kAtOnce);)
    {
      count = dds_takecdr(reader.entity, messages.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
      for (int i = 0; i < count; ++i)
      {
        if (infos[i].valid_data) keep(reader.topic, bytesOf(messages[i]));
        ddsi_serdata_unref(messages[i]);
      }
    }
  }

  /** The newest messages, as far as the memory goes. */
  void keep(const Ros2Topic& topic, Bytes bytes)
  {
    const Timestamp now = started_ + std::chrono::duration_cast<Duration>(Steady::now() - steady_start_);
    const std::lock_guard lock(queue_mutex_);
    queue_.push_back({topic, now, {bytes.begin(), bytes.end()}});
    waiting_ += bytes.size();
    for (; waiting_ > kMemory && queue_.size() > 1; queue_.pop_front())
    {
      waiting_ -= queue_.front().data.size();
      ++dropped_;
    }
    arrived_.notify_one();
  }

  bool long_ids_;
  std::string name_space_, name_;
  dds_entity_t domain_ = 0, participant_ = 0, discovery_ = 0, waitset_ = 0, stop_ = 0;
  Writer nodes_;

  mutable std::mutex mutex_;
  std::map<Guid, Publisher> publishers_;
  std::vector<std::string> wanted_;  // topics
  std::vector<Reader> readers_;
  std::deque<Writer> writers_;
  std::uint64_t lost_ = 0;  // by readers that are no more

  std::mutex queue_mutex_;
  std::condition_variable arrived_;
  std::deque<Ros2Message> queue_;
  std::size_t waiting_ = 0;  // bytes
  std::atomic<std::uint64_t> dropped_{0};
  // The stamps' clock begins as the computer's and is never set.
  Steady::time_point steady_start_ = Steady::now();
  Timestamp started_{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
  std::thread thread_;
};
}  // namespace
}  // namespace scanloom

extern "C" scanloom::Ros2Node* scanloomRos2Node(const scanloom::Ros2Network& network, const std::string& name_space,
                                                const std::string& name)
{
  return new scanloom::CycloneNode(network, name_space, name);
}
