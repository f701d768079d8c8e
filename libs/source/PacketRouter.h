#pragma once
#include "lidar/PacketDecoder.h"
#include "source/Datagram.h"

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
  std::uint16_t lidar_port = 0;     // must be known
  std::uint16_t imu_port = 0;       // may be the same; 0 if there is none
  std::optional<IpAddress> source;  // the sensor's own address, where ports alone do not tell sensors apart
};

struct RoutedLidar
{
  std::string label;  // what the configuration calls the lidar
  LidarAddress address;
  const PacketDecoder* decoder = nullptr;  // must outlive the router; null: not known yet, no datagram is this lidar's
};

struct Routed
{
  std::size_t lidar = 0;  // place in the router's list
  PacketKind kind = PacketKind::Other;
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
 * Decides whose a datagram is: first by port and configured source address, then by what the decoders make of it (size,
 * type, serial), last by the source addresses that unmistakable packets came from.
 */
class PacketRouter
{
 public:
  /** Throws std::invalid_argument if a lidar has no lidar_port. */
  explicit PacketRouter(std::vector<RoutedLidar> lidars);

  /**
   * Nothing for a datagram that is no lidar's, or an IMU packet without serial that could still be of several.
   * Throws std::runtime_error for a lidar packet that two lidars could have sent: only the configuration can tell them
   * apart.
   */
  std::optional<Routed> route(const DatagramView&);

  /** The lidar is another one from here on. Throws as the constructor does. */
  void replace(std::size_t lidar, const LidarAddress&, const PacketDecoder*);

  /** Datagrams that were given to no lidar; from the 1000th stranger on, under port 0 of no address. */
  const std::map<Origin, std::uint64_t>& unmatched() const { return unmatched_; }

 private:
  std::vector<Routed> candidates(const DatagramView&) const;
  std::vector<Routed> fromKnownSource(const std::vector<Routed>& candidates, const IpAddress& source) const;
  std::optional<Routed> decide(const DatagramView&);
  Origin strangerOf(const DatagramView&) const;
  std::runtime_error ambiguous(const DatagramView&, const std::vector<Routed>&) const;

  std::vector<RoutedLidar> lidars_;
  std::map<IpAddress, std::set<std::size_t>> lidars_at_;  // learned from packets that only one lidar can have sent
  std::map<Origin, std::uint64_t> unmatched_;
};
}  // namespace scanloom
