/** What `scanloom doctor` keeps of a rig's datagrams until it measures. */
#pragma once
#include "diagnosis/internal/PacketTrace.h"
#include "diagnosis/internal/Snapshots.h"
#include "input/packets/UdpReceiver.h"
#include "input/rig/PacketRouter.h"
#include "input/rig/Rig.h"

#include <map>
#include <string>
#include <vector>

namespace scanloom
{
struct LidarEvidence
{
  std::string name;
  LidarDescription lidar;
  std::vector<PacketTrace> packets;  // in the order of arrival
  std::uint64_t malformed = 0, bad_crc = 0;
};

struct ImuEvidence
{
  std::string name;  // "imu" on the body, "imu_left" in the lidar 'left'
  std::vector<ImuSample> samples;
  Rigid body_T_imu;
  Rigid configured_pose;  // of the IMU, or of the lidar that holds it
};

/** Counters of live sockets. */
struct SocketAccount
{
  UdpCounters counters;
  std::uint64_t clock_steps = 0;      // of the computer's clock
  std::vector<std::string> warnings;  // messages
};

/** Facts on a rig that need no measurement. */
struct RigFacts
{
  std::map<Origin, std::uint64_t> other_senders;  // datagrams to the lidars' ports from other senders
  std::vector<std::string> wrong_keys;   // of the router: a port or an address that the configuration has wrong
  std::optional<SocketAccount> sockets;  // live only
  bool packets_known = true;             // false for rawlogs and clouds, which hold no packets
  bool poses_known = false;              // false: sensor frames are used as the body frame
  Duration deadline{0};                  // configured for the batcher
};

struct RigEvidence : RigFacts
{
  std::vector<LidarEvidence> lidars;
  std::vector<RigSnapshot> snapshots;
  std::vector<ImuEvidence> imus;  // with at least one sample; the body's IMU first
};

/**
 * Gathers evidence from datagrams in the order of arrival, of a capture or live. Memory: 64 bytes for each lidar packet
 * and all points of a few turns.
 */
class RigListener
{
 public:
  /** Applies the time offsets of the configuration, as the batcher does. Throws what PacketRouter throws. */
  RigListener(const Rig&, bool poses_known);

  /** Throws what PacketRouter::route throws. */
  void add(const DatagramView&);
  void add(SocketAccount account) { evidence_.sockets = std::move(account); }

  RigEvidence finish();

 private:
  void addPacket(const RoutedPacket&);

  std::vector<BatchedLidar> lidars_;
  std::vector<LidarAddress> addresses_;
  PacketRouter router_;
  SnapshotTaker snapshots_;
  std::vector<Duration> delays_;  // of each lidar's latest packet, to unwrap stamps; 0 before the first packet
  RigEvidence evidence_;
};
}  // namespace scanloom
