/** A node of ROS 2 without ROS: topics by the names of ROS, messages as the bytes that bags hold (CDR). */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Which other programs a node of ROS 2 hears, and by which means. */
struct Ros2Network
{
  enum class Range
  {
    Subnet,     // of all computers that multicast reaches
    Localhost,  // of this computer
    Off,        // of nobody
    Default,    // what Cyclone DDS is configured to
  };

  int domain = 0;
  Range range = Range::Subnet;
  std::vector<std::string> peers;  // hosts that are asked besides: names or addresses
  std::string configuration;       // of Cyclone DDS, CYCLONEDDS_URI: XML or "file://..."; empty: its defaults
  bool long_ids = false;           // ROS 2 up to Humble wrote identifiers of 24 bytes, later ones have 16
};

/**
 * By ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE (or ROS_LOCALHOST_ONLY=1), ROS_STATIC_PEERS, CYCLONEDDS_URI and
 * ROS_DISTRO, as programs of ROS 2 are. Throws ConfigError, naming the variable, for what ROS 2 would not take.
 */
Ros2Network ros2NetworkOfEnvironment();

struct Ros2Topic
{
  std::string name;  // "/left/points"
  std::string type;  // "sensor_msgs/msg/PointCloud2"

  bool operator==(const Ros2Topic& other) const { return name == other.name && type == other.type; }
};

/** A topic that somebody publishes. */
struct Ros2Publication
{
  Ros2Topic topic;
  std::size_t publishers = 0;
  bool reliable = true;              // by all publishers
  bool kept_for_latecomers = false;  // by all publishers: "transient local"
};

struct Ros2Message
{
  Ros2Topic topic;
  Timestamp received;  // host time
  std::vector<std::uint8_t> data;
};

/** What of a topic is kept for readers that are slow or come late. */
struct Ros2Keep
{
  int messages = 10;
  bool for_latecomers = false;
};

/** What went wrong on the way in, since the start. */
struct Ros2Losses
{
  std::uint64_t dropped = 0;  // messages that nobody took in time
  std::uint64_t lost = 0;     // messages that did not come through the network
};

/** From any thread. Nothing in it waits for another program. */
class Ros2Node
{
 public:
  virtual ~Ros2Node() = default;

  /** What other nodes publish, as far as they were discovered; by name and type. */
  virtual std::vector<Ros2Publication> publications() const = 0;

  /**
   * From now on next() gives the messages of this topic, whatever their type, also of publishers that come later.
   * Reliably, and with what is kept for latecomers, where all publishers offer it.
   */
  virtual void subscribe(const std::string& topic) = 0;

  /** From all topics; what waits is dropped. A later subscribe() gives what is kept for latecomers again. */
  virtual void unsubscribe() = 0;

  /** In the order of arrival; nothing if none came within `patience`. */
  virtual std::optional<Ros2Message> next(Duration patience) = 0;

  virtual Ros2Losses losses() const = 0;

  /** @return the number by which it is published. Reliable, the newest `keep.messages` for each reader. */
  virtual std::size_t advertise(const Ros2Topic&, const Ros2Keep&) = 0;

  /**
   * A message with its encapsulation (4 bytes, MessageWriter). A reader that does not keep up loses what is older than
   * the newest messages; nobody else notices. @return false if DDS could not send it.
   */
  virtual bool publish(std::size_t topic, std::vector<std::uint8_t> message) = 0;

  /** Whether somebody reads the topic, so that it is worth to make a message. */
  virtual bool hasReaders(std::size_t topic) const = 0;
};

/**
 * Loads libscanloom_dds.so (Cyclone DDS) at the first call: a program without ROS 2 needs neither. `name` and
 * `name_space` are what `ros2 node list` shows: NAMESPACE/NAME. Throws std::runtime_error if the library cannot be
 * loaded, or the network cannot be used.
 */
std::unique_ptr<Ros2Node> openRos2Node(const Ros2Network&, const std::string& name_space, const std::string& name);

/** "rt/left/points": the topic's name in DDS. */
std::string ddsTopicOf(const std::string& ros_topic);

/** "sensor_msgs::msg::dds_::Imu_": the type's name in DDS. Throws std::invalid_argument for what is no type of ROS 2.
 */
std::string ddsTypeOf(const std::string& ros_type);

/** The inverses; none for the topics of services, of actions and of other programs than ROS 2's. */
std::optional<Ros2Topic> rosTopicOf(const std::string& dds_topic, const std::string& dds_type);

/** Whether ROS 2 takes it as the name of a topic or namespace: "/left/points". */
bool isRosName(const std::string&);
}  // namespace scanloom
