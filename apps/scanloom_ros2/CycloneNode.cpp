/** libscanloom_dds.so: what libs/input/ros2/Ros2Node.h promises, by Cyclone DDS. */
#include "MessageQueue.h"
#include "Publishers.h"
#include "RawMessages.h"
#include "cyclone.h"
#include "cycloneConfiguration.h"
#include "input/ros2/Ros2Node.h"
#include "nodeMessage.h"

#include <dds/dds.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <set>
#include <thread>

namespace scanloom
{
namespace
{
constexpr int kKeptByReaders = 4000;  // messages between two looks at a topic: three seconds of its packets

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
    return publishers_.publications();
  }

  void subscribe(const std::string& topic) override
  {
    const std::lock_guard lock(mutex_);
    wanted_.insert(topic);
    followPublishers();
  }

  void unsubscribe() override
  {
    const std::lock_guard lock(mutex_);
    wanted_.clear();
    while (!readers_.empty()) removeReader(std::prev(readers_.end()));
    introduce();
    queue_.clear();
  }

  std::optional<Ros2Message> next(Duration patience) override { return queue_.next(patience); }

  Ros2Losses losses() const override
  {
    const std::lock_guard lock(mutex_);
    Ros2Losses losses{queue_.dropped(), lost_};
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
  struct Reader
  {
    Ros2Publication of;  // as its publishers were when it was made
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
    dds_guid_t own{};
    dds_get_guid(participant_, &own);
    const std::lock_guard lock(mutex_);
    std::array<void*, kAtOnce> samples{};
    std::array<dds_sample_info_t, kAtOnce> infos;
    for (int count = 1; count > 0;)
    {
      count = dds_take(discovery_, samples.data(), infos.data(), kAtOnce, kAtOnce);
      for (int i = 0; i < count; ++i)
        publishers_.follow(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]), infos[i], own);
      if (count > 0) dds_return_loan(discovery_, samples.data(), count);
    }
    followPublishers();
  }

  /** A reader for each type of a wanted topic, which asks for no more than all of its publishers offer. */
  void followPublishers()
  {
    bool changed = false;
    for (const Ros2Publication& offer : publishers_.publications())
    {
      if (wanted_.count(offer.topic.name) == 0) continue;
      const auto reads = [&](const Reader& reader) { return reader.of.topic == offer.topic; };
      const auto known = std::find_if(readers_.begin(), readers_.end(), reads);
      const bool fits = known != readers_.end() && (offer.reliable || !known->of.reliable) &&
                        (offer.kept_for_latecomers || !known->of.kept_for_latecomers);
      if (fits) continue;
      if (known != readers_.end()) removeReader(known);
      addReader(offer);
      changed = true;
    }
    if (changed) introduce();
  }

  void addReader(const Ros2Publication& offer)
  {
    ddsi_sertype* type = rawType(ddsTypeOf(offer.topic.type));
    const dds_entity_t topic = createTopic(ddsTopicOf(offer.topic.name), &type);
    const Qos qos = qosOf(offer.reliable, offer.kept_for_latecomers, kKeptByReaders);
    const Reader reader{
        offer, checked(dds_create_reader(participant_, topic, qos.get(), nullptr), "no reader of " + offer.topic.name)};
    dds_set_status_mask(reader.entity, DDS_DATA_AVAILABLE_STATUS);
    attach(reader.entity);
    readers_.push_back(reader);
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
        if (infos[i].valid_data) queue_.push(reader.of.topic, bytesOf(messages[i]));
        ddsi_serdata_unref(messages[i]);
      }
    }
  }

  bool long_ids_;
  std::string name_space_, name_;
  dds_entity_t domain_ = 0, participant_ = 0, discovery_ = 0, waitset_ = 0, stop_ = 0;
  Writer nodes_;

  mutable std::mutex mutex_;
  Publishers publishers_;
  std::set<std::string> wanted_;  // topics
  std::vector<Reader> readers_;
  std::deque<Writer> writers_;
  std::uint64_t lost_ = 0;  // by readers that are no more

  MessageQueue queue_;
  std::thread thread_;
};
}  // namespace
}  // namespace scanloom

extern "C" scanloom::Ros2Node* scanloomRos2Node(const scanloom::Ros2Network& network, const std::string& name_space,
                                                const std::string& name)
{
  return new scanloom::CycloneNode(network, name_space, name);
}
