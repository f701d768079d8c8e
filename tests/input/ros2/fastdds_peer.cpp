/**
 * Another vendor's DDS among the topics of ROS 2, as raw bytes: what is no code of ours, on the other side.
 *
 *   fastdds_peer hear OUT.mcap SECONDS [--reliable] [--stall-after S] TOPIC=TYPE...
 *   fastdds_peer play BAG|CAPTURE [METADATA.json...] [--best-effort] [--only TOPIC] [--from S] [--to S]
 *     [--at UNIX_S]
 *   fastdds_peer flood SECONDS TOPIC=TYPE...
 *   fastdds_peer compare BAG TOPIC BAG TOPIC
 *
 * `hear` writes what it receives and prints a line per topic: messages, bytes, and the time between the sending and the
 * reception in ms (median, 99.9 %, largest). `play` publishes a bag's messages at the pace of the recording, or the
 * packets of a capture as Ouster's driver does; `--only` those of one topic, from S to S of the recording (s), which
 * begins at UNIX_S: several peers may share it. `flood` publishes random bytes, 1 kB every ms on each topic.
 */
#include "FastddsRawType.h"
#include "base/core/OutputFile.h"
#include "input/bags/BagReader.h"
#include "input/bags/MessageWriter.h"
#include "input/bags/RosDefinitions.h"
#include "input/lidar/LidarModels.h"
#include "input/packets/CaptureReader.h"
#include "input/ros2/Ros2Node.h"

#include <fmt/format.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

using namespace scanloom;

namespace
{
std::atomic<bool> ended{false};

Timestamp now()
{
  return Timestamp{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
}

class Participant
{
 public:
  Participant()
  {
    const Ros2Network network = ros2NetworkOfEnvironment();
    fdds::DomainParticipantQos qos;
    qos.name("fastdds_peer");
    // As ROS 2's pages on large messages advise: by default a scan is larger than what the kernel keeps for a socket.
    if (!std::getenv("FASTDDS_SMALL_BUFFERS")) qos.transport().listen_socket_buffer_size = 4 << 20;
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(network.domain), qos);
    if (!participant_) throw std::runtime_error("Fast DDS has no participant");
  }

  fdds::DomainParticipant& operator*() const { return *participant_; }
  fdds::DomainParticipant* operator->() const { return participant_; }

  fdds::Topic* topic(const Ros2Topic& topic)
  {
    fdds::TypeSupport type(new RawType(ddsTypeOf(topic.type)));
    type.register_type(participant_);
    fdds::Topic* made =
        participant_->create_topic(ddsTopicOf(topic.name), type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
    if (!made) throw std::runtime_error("Fast DDS has no topic " + topic.name);
    return made;
  }

 private:
  fdds::DomainParticipant* participant_ = nullptr;
};

/** What came on a topic. */
class Listener : public fdds::DataReaderListener
{
 public:
  using Take = std::function<void(std::vector<std::uint8_t>, Timestamp sent)>;

  explicit Listener(Take take) : take_(std::move(take)) {}

  void on_data_available(fdds::DataReader* reader) override
  {
    RawType::Data data;
    fdds::SampleInfo info;
    while (reader->take_next_sample(&data, &info) == kFastddsOk)
      if (info.valid_data) take_(data, Timestamp{Duration{info.source_timestamp.to_ns()}});
  }

 private:
  Take take_;
};

/** "/points=sensor_msgs/msg/PointCloud2" */
Ros2Topic topicOf(const std::string& argument)
{
  const std::size_t equals = argument.find('=');
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

struct Heard
{
  Ros2Topic topic;
  std::uint16_t number = 0;
  std::uint64_t messages = 0, bytes = 0;
  std::vector<double> latencies;  // ms
};

std::string lineOf(Heard& heard)
{
  std::sort(heard.latencies.begin(), heard.latencies.end());
  const auto quantile = [&](double q)
  {
    if (heard.latencies.empty()) return 0.0;
    const double place = q * static_cast<double>(heard.latencies.size() - 1);
    return heard.latencies[static_cast<std::size_t>(place)];
  };
  return fmt::format("{} {} messages {} bytes latency {:.2f} {:.2f} {:.2f}\n", heard.topic.name, heard.messages,
                     heard.bytes, quantile(0.5), quantile(0.999), quantile(1));
}

int hear(const std::vector<std::string>& arguments)
{
  const std::string out = arguments.at(0);
  const double seconds_to_listen = std::stod(arguments.at(1));
  bool reliable = false;
  double stall_after = 0;
  std::vector<Ros2Topic> topics;
  for (std::size_t i = 2; i < arguments.size(); ++i)
  {
    const std::string& argument = arguments[i];
    if (argument == "--reliable")
      reliable = true;
    else if (argument == "--stall-after")
      stall_after = std::stod(arguments.at(++i));
    else
      topics.push_back(topicOf(argument));
  }
  OutputFile file(out);
  McapWriter writer(file.stream());
  std::mutex mutex;
  std::vector<std::unique_ptr<Heard>> all;
  std::vector<std::unique_ptr<Listener>> listeners;
  Participant participant;
  fdds::Subscriber* const subscriber = participant->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT);
  for (const Ros2Topic& topic : topics)
  {
    all.push_back(std::make_unique<Heard>());
    Heard* const heard = all.back().get();
    heard->topic = topic;
    heard->number = writer.addTopic(topic.name, schemaOf(topic.type));
    listeners.push_back(std::make_unique<Listener>(
        [&, heard, stall_after](std::vector<std::uint8_t> data, Timestamp sent)
        {
          const Timestamp received = now();
          const std::lock_guard lock(mutex);
          ++heard->messages;
          heard->bytes += data.size();
          heard->latencies.push_back(1e3 * seconds(received - sent));
          writer.add(heard->number, received, data);
        }));
    fdds::DataReaderQos qos;
    qos.reliability().kind = reliable ? fdds::RELIABLE_RELIABILITY_QOS : fdds::BEST_EFFORT_RELIABILITY_QOS;
    qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 50;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    if (topic.name == "/tf_static" || topic.name.find("/map") != std::string::npos)
    {
      qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
      qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
      qos.history().depth = 1000;
    }
    if (!subscriber->create_datareader(participant.topic(topic), qos, listeners.back().get()))
      throw std::runtime_error("no reader of " + topic.name);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto since = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  while (!ended && since() < seconds_to_listen)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (stall_after > 0 && since() > stall_after) raise(SIGSTOP);
  }
  {
    const std::lock_guard lock(mutex);
    for (const auto& heard : all) fmt::print("{}", lineOf(*heard));
    std::fflush(stdout);
    writer.close();
    file.commit();
  }
  std::_Exit(0);  // Fast DDS takes seconds to end
}

/** A message of a recording, to be sent at its time. */
struct Recorded
{
  Ros2Topic topic;
  Timestamp received;
  RawType::Data data;
};

/** The packets of a capture, and the metadata before them, on the topics of Ouster's driver: /left/lidar_packets. */
void forEachPacket(const std::string& capture, const std::vector<std::filesystem::path>& metadata,
                   const std::function<bool(Recorded)>& send)
{
  CaptureReader reader(capture);
  std::map<std::uint16_t, std::string> topics;  // by port
  std::vector<std::pair<std::string, std::string>> texts;
  for (const std::filesystem::path& file : metadata)
  {
    std::ifstream stream(file);
    const std::string text(std::istreambuf_iterator<char>(stream), {}), name = "/" + file.stem().string();
    const LidarDescription description = makeDecoder(text, file.string(), Rigid::identity())->description();
    topics[description.lidar_port] = name + "/lidar_packets";
    topics[description.imu_port] = name + "/imu_packets";
    texts.emplace_back(name + "/metadata", text);
  }
  Datagram datagram;
  for (bool first = true; reader.next(datagram); first = false)
  {
    for (std::size_t i = 0; first && i < texts.size(); ++i)
    {
      MessageWriter text;
      text.string(texts[i].second);
      send({{texts[i].first, "std_msgs/msg/String"}, datagram.received, text.bytes()});
    }
    MessageWriter packet;
    packet.byteSequence(datagram.payload);
    const auto topic = topics.find(datagram.destination_port);
    if (topic != topics.end() &&
        !send({{topic->second, "ouster_sensor_msgs/msg/PacketMsg"}, datagram.received, packet.bytes()}))
      return;
  }
}

void forEachMessage(const std::string& path, const std::function<bool(Recorded)>& send)
{
  const auto bag = BagReader::open(path);
  for (BagMessage message; bag->next(message);)
  {
    const BagTopic& topic = bag->topics()[message.topic];
    std::string type = topic.type;
    type.replace(type.find('/'), 1, "/msg/");
    if (!send({{topic.name, type}, message.received, {message.data.begin(), message.data.end()}})) return;
  }
}

/** What a publisher promises: as drivers do, or reliably. */
fdds::DataWriterQos qosOf(const Ros2Topic& topic, bool best_effort)
{
  fdds::DataWriterQos qos;
  const bool is_kept = topic.name.find("static") != std::string::npos || topic.type == "std_msgs/msg/String";
  qos.reliability().kind = best_effort && !is_kept ? fdds::BEST_EFFORT_RELIABILITY_QOS : fdds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = is_kept ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS : fdds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 200;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  return qos;
}

struct Played
{
  std::vector<std::string> files;
  bool best_effort = false;
  std::string only;
  double from = 0, to = 1e9;                                       // s of the recording
  double at = 1e-9 * static_cast<double>(nanoseconds(now())) + 2;  // Unix time in s: others have discovered it by then
};

Played playedOf(const std::vector<std::string>& arguments)
{
  Played played;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (arguments[i] == "--best-effort")
      played.best_effort = true;
    else if (arguments[i] == "--only")
      played.only = arguments.at(++i);
    else if (arguments[i] == "--from")
      played.from = std::stod(arguments.at(++i));
    else if (arguments[i] == "--to")
      played.to = std::stod(arguments.at(++i));
    else if (arguments[i] == "--at")
      played.at = std::stod(arguments.at(++i));
    else
      played.files.push_back(arguments[i]);
  return played;
}

int play(const std::vector<std::string>& arguments)
{
  using Clock = std::chrono::system_clock;
  const Played played = playedOf(arguments);
  const Clock::time_point start{std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(played.at))};
  const std::string recording = played.files.at(0);
  const std::vector<std::filesystem::path> metadata(played.files.begin() + 1, played.files.end());

  std::optional<Timestamp> first;
  const auto forEach = [&](const std::function<bool(Recorded, Duration)>& send)
  {
    const auto sendChosen = [&](Recorded message)
    {
      if (!first) first = message.received;
      const Duration at = message.received - *first;
      if (seconds(at) > played.to || ended) return false;
      const bool is_chosen = played.only.empty() || message.topic.name == played.only;
      return !is_chosen || seconds(at) < played.from || send(std::move(message), at);
    };
    isBag(recording) ? forEachMessage(recording, sendChosen) : forEachPacket(recording, metadata, sendChosen);
  };
  const auto waitUntil = [&](Duration at)
  {
    while (!ended && Clock::now() < start + at)
      std::this_thread::sleep_until(std::min(start + at, Clock::now() + std::chrono::milliseconds(50)));
  };
  // A driver that is started late is discovered late.
  waitUntil(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(played.from - 2)));

  Participant participant;
  fdds::Publisher* const publisher = participant->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
  std::map<std::string, fdds::DataWriter*> writers;
  const auto advertise = [&](const Ros2Topic& topic)
  {
    fdds::DataWriter*& writer = writers[topic.name];
    if (!writer) writer = publisher->create_datawriter(participant.topic(topic), qosOf(topic, played.best_effort));
    return writer;
  };
  int looked_at = 0;
  forEach([&](const Recorded& message, Duration) { return advertise(message.topic), ++looked_at < 1000; });

  std::uint64_t messages = 0;
  forEach(
      [&](Recorded message, Duration at)
      {
        waitUntil(at);
        advertise(message.topic)->write(&message.data);
        ++messages;
        return true;
      });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  fmt::print("{} messages\n", messages);
  std::fflush(stdout);
  std::_Exit(0);
}

int flood(const std::vector<std::string>& arguments)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(std::stod(arguments.at(0)));
  Participant participant;
  fdds::Publisher* const publisher = participant->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
  std::vector<fdds::DataWriter*> writers;
  for (const std::string& argument : std::vector<std::string>(arguments.begin() + 1, arguments.end()))
  {
    const Ros2Topic topic = topicOf(argument);
    writers.push_back(publisher->create_datawriter(participant.topic(topic), qosOf(topic, true)));
  }
  std::mt19937 random(1);
  RawType::Data data(1000);
  std::uint64_t messages = 0;
  for (; !ended && std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    for (fdds::DataWriter* const writer : writers)
    {
      std::generate(data.begin(), data.end(), [&] { return static_cast<std::uint8_t>(random()); });
      if (messages % 2 == 0) std::copy_n("\0\1\0", 4, data.begin());  // of CDR, which another node may look at
      writer->write(&data);
      ++messages;
    }
  fmt::print("{} messages\n", messages);
  std::fflush(stdout);
  std::_Exit(0);
}

/** A cloud of ours with its points' times apart, which a rawlog rounds: it keeps float32, in s. */
struct ComparedCloud
{
  RawType::Data bytes;  // with 0 for each time
  std::vector<std::uint32_t> times;

  explicit ComparedCloud(Bytes message) : bytes(message.begin(), message.end())
  {
    constexpr std::size_t kStep = 24, kTime = 16;
    MessageReader reader(message, Serialisation::Cdr);
    reader.header();
    reader.number<std::uint32_t>();  // rows
    const std::size_t points = reader.number<std::uint32_t>();
    for (std::size_t at = bytes.size() - 1 - points * kStep + kTime; at < bytes.size(); at += kStep)
    {
      times.push_back(load<std::uint32_t>(bytes, at));
      store(bytes, at, std::uint32_t{0});
    }
  }

  bool isSame(const ComparedCloud& other) const
  {
    constexpr double kRounding = 8;  // ns, a step of float32 at 0.1 s
    const auto near = [](double a, double b) { return std::abs(a - b) <= kRounding; };
    return bytes == other.bytes && std::equal(times.begin(), times.end(), other.times.begin(), other.times.end(), near);
  }
};

/** Whether each cloud of a topic is one of another bag's topic, which was made of a rawlog. */
int compare(const std::vector<std::string>& arguments)
{
  const auto cloudsOf = [](const std::string& path, const std::string& topic)
  {
    std::map<std::int64_t, ComparedCloud> clouds;  // by stamp
    const auto bag = BagReader::open(path);
    for (BagMessage message; bag->next(message);)
      if (bag->topics()[message.topic].name == topic)
        clouds.emplace(nanoseconds(MessageReader(message.data, Serialisation::Cdr).time()), message.data);
    return clouds;
  };
  const auto heard = cloudsOf(arguments.at(0), arguments.at(1)), written = cloudsOf(arguments.at(2), arguments.at(3));
  std::size_t same = 0;
  for (const auto& [stamp, cloud] : heard)
    if (const auto other = written.find(stamp); other != written.end() && cloud.isSame(other->second)) ++same;
  fmt::print("{} of {} clouds are the same, of {}\n", same, heard.size(), written.size());
  return heard.empty() || same < heard.size() ? 1 : 0;
}
}  // namespace

int main(int argc, char** argv)
try
{
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { ended = true; });
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() > 2 && arguments[0] == "hear") return hear({arguments.begin() + 1, arguments.end()});
  if (arguments.size() > 1 && arguments[0] == "play") return play({arguments.begin() + 1, arguments.end()});
  if (arguments.size() > 2 && arguments[0] == "flood") return flood({arguments.begin() + 1, arguments.end()});
  if (arguments.size() == 5 && arguments[0] == "compare") return compare({arguments.begin() + 1, arguments.end()});
  fmt::print(stderr, "usage: fastdds_peer hear|play|flood|compare ARGUMENTS (see the head of its source)\n");
  return 2;
}
catch (const std::exception& e)
{
  fmt::print(stderr, "fastdds_peer: {}\n", e.what());
  return 1;
}
