#pragma once
#include "input/batching/RoutedPacket.h"
#include "input/packets/Datagram.h"
#include "input/rig/internal/LidarSender.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace scanloom
{
/** Where a lidar's packets arrive. */
struct LidarAddress
{
  std::uint16_t lidar_port = 0;     // 0 only where there is a topic
  std::uint16_t imu_port = 0;       // may be the same; 0 if there is none
  std::optional<IpAddress> source;  // of the sensor; needed where sensors send to the same port
  std::string key{};                // of its keys in the configuration: "lidar2" of lidar2_port; empty if there is none
  std::string topic{}, imu_topic{};  // of a bag, instead of the ports

  bool hasImu() const { return imu_port != 0 || !imu_topic.empty(); }

  /** Whether datagrams to this port or messages of this topic are for the lidar. */
  bool receives(std::uint16_t port, std::string_view message_topic) const;
};

struct RoutedLidar
{
  std::string label;  // what the configuration calls the lidar
  LidarAddress address;
  const PacketDecoder* decoder = nullptr;  // must outlive the router; null: not known yet, it gets no datagram
};

/** Sender and port of datagrams, or the topic of messages. */
struct Origin
{
  std::uint16_t destination_port = 0;
  IpAddress source;
  std::string topic{};

  bool operator==(const Origin& other) const
  {
    return destination_port == other.destination_port && source == other.source && topic == other.topic;
  }
  bool operator<(const Origin& other) const
  {
    return std::tie(destination_port, source, topic) < std::tie(other.destination_port, other.source, other.topic);
  }

  /** "from 10.0.0.7 to port 7502", or "on topic /left/packets". */
  std::string text() const;
};

Origin originOf(const DatagramView&);

/**
 * Decides which lidar has sent a datagram, and classifies and reads it once. Tests go from cheap to dear: port or
 * topic, configured source address; size, type and serial number; the checksum, for the lidars that are left; and last
 * the source address: where several could have sent it, and against unknown senders that copy a lidar's serial number
 * (see LidarSender).
 */
class PacketRouter
{
 public:
  /** Throws std::invalid_argument if a lidar has neither lidar_port nor topic. */
  explicit PacketRouter(std::vector<RoutedLidar> lidars);

  /** None for a datagram that no lidar has sent, that several could have sent, or that comes from a second sender. */
  std::optional<RoutedPacket> route(const DatagramView&);

  /** From here on the lidar sends to this address, in this decoder's format. Throws as the constructor does. */
  void replace(LidarIndex, const LidarAddress&, const PacketDecoder*);

  /** Datagrams that were given to no lidar. Origins beyond the first 1000 are counted under port 0 of no address. */
  const std::map<Origin, std::uint64_t>& unmatched() const { return unmatched_; }

  /** Those of them that were like this lidar's, but came from another address than its own. */
  std::uint64_t ofOtherSenders(LidarIndex lidar) const { return of_other_senders_[lidar]; }

  /** What a person should know and mend in the configuration, since the last call. */
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  struct Candidate
  {
    LidarIndex lidar = 0;
    PacketKind kind = PacketKind::Foreign;
  };
  using Candidates = std::vector<Candidate>;

  /** Whether packets came to the port where they should. */
  struct Received
  {
    bool lidar = false, imu = false;
  };

  Candidates listenersTo(const DatagramView&) const;
  Candidates bestOf(Candidates, Bytes packet) const;
  Candidates fromKnownSource(const Candidates&, const IpAddress& source) const;
  std::optional<Candidate> decide(const DatagramView&);
  void noticeWrongPort(const DatagramView&);
  void noticeOtherSensor(const DatagramView&);
  bool isElsewhere(LidarIndex) const;
  bool isDueToReport(LidarIndex, PacketKind, const DatagramView&);
  LidarSender::Verdict judgeSender(const Candidate&, const DatagramView&);
  Origin countedOrigin(const DatagramView&) const;
  void warnOfAmbiguity(const DatagramView&, const Candidates&);
  void warnOfSender(LidarIndex, const IpAddress& source, const IpAddress& kept, LidarSender::Verdict);

  std::vector<RoutedLidar> lidars_;
  std::vector<std::optional<LidarSender>> senders_;  // of each lidar; none while it is not known
  std::map<Origin, std::uint64_t> unmatched_;
  std::vector<std::uint64_t> of_other_senders_;  // of each lidar
  std::vector<Received> received_;               // of each lidar
  std::map<std::tuple<LidarIndex, PacketKind, std::string>, int>
      elsewhere_;  // packets at another place, and those of another sensor (Foreign) at its own, up to a limit
  std::set<std::string> ambiguous_places_;                       // that were reported
  std::set<std::pair<LidarIndex, IpAddress>> reported_senders_;  // those of other addresses, up to a limit
  std::vector<std::string> warnings_;
};
}  // namespace scanloom
