#pragma once
#include "batching/RoutedPacket.h"
#include "packets/Datagram.h"

#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace scanloom
{
/** Where a lidar's packets arrive. */
struct LidarAddress
{
  std::uint16_t lidar_port = 0;     // never 0
  std::uint16_t imu_port = 0;       // may be the same; 0 if there is none
  std::optional<IpAddress> source;  // of the sensor; needed where sensors send to the same port
};

struct RoutedLidar
{
  std::string label;  // what the configuration calls the lidar
  LidarAddress address;
  const PacketDecoder* decoder = nullptr;  // must outlive the router; null: not known yet, it gets no datagram
};

/** Sender and port of datagrams. */
struct Origin
{
  std::uint16_t destination_port = 0;
  IpAddress source;

  bool operator==(const Origin& other) const
  {
    return destination_port == other.destination_port && source == other.source;
  }
  bool operator<(const Origin& other) const
  {
    return std::tie(destination_port, source) < std::tie(other.destination_port, other.source);
  }
};

/**
 * Decides which lidar has sent a datagram, and classifies and reads it once. Tests go from cheap to dear: port and
 * configured source address; size, type and serial number; the checksum, for the lidars that are left; and last, where
 * several could have sent it, the source addresses of lidar packets that only one could have sent.
 */
class PacketRouter
{
 public:
  /** Throws std::invalid_argument if a lidar has no lidar_port. */
  explicit PacketRouter(std::vector<RoutedLidar> lidars);

  /**
   * None for a datagram that no lidar has sent, and for an IMU packet without serial number that several could have
   * sent. Throws std::runtime_error for a lidar packet that several could have sent: only the configuration can tell
   * them apart.
   */
  std::optional<RoutedPacket> route(const DatagramView&);

  /** From here on the lidar sends to this address, in this decoder's format. Throws as the constructor does. */
  void replace(LidarIndex, const LidarAddress&, const PacketDecoder*);

  /** Datagrams that were given to no lidar. Origins beyond the first 1000 are counted under port 0 of no address. */
  const std::map<Origin, std::uint64_t>& unmatched() const { return unmatched_; }

 private:
  struct Candidate
  {
    LidarIndex lidar = 0;
    PacketKind kind = PacketKind::Foreign;
  };
  using Candidates = std::vector<Candidate>;

  Candidates listenersTo(const DatagramView&) const;
  Candidates bestOf(Candidates, Bytes packet) const;
  Candidates fromKnownSource(const Candidates&, const IpAddress& source) const;
  std::optional<Candidate> decide(const DatagramView&);
  Origin countedOrigin(const DatagramView&) const;
  std::runtime_error ambiguous(const DatagramView&, const Candidates&) const;

  std::vector<RoutedLidar> lidars_;
  std::map<IpAddress, std::set<LidarIndex>> lidars_at_;  // by lidar packets that only one lidar can have sent
  std::map<Origin, std::uint64_t> unmatched_;
};
}  // namespace scanloom
