/** What a rig's datagrams tell, kept as far as the measures of `scanloom doctor` need it. */
#pragma once
#include "dataset/PacketTrace.h"
#include "dataset/Snapshots.h"
#include "source/PacketRouter.h"
#include "source/Rig.h"
#include "source/UdpReceiver.h"

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
};

/** What live sockets tell of themselves. */
struct SocketAccount
{
  UdpCounters counters;
  std::uint64_t clock_steps = 0;      // of the computer
  std::vector<std::string> warnings;  // for a person
};

struct RigEvidence
{
  std::vector<LidarEvidence> lidars;
  std::vector<RigSnapshot> snapshots;
  std::map<Origin, std::uint64_t> strangers;  // datagrams that are no lidar's, though they came to our ports
  std::optional<SocketAccount> sockets;       // live only
  bool packets_known = true;                  // false for a rawlog, which holds none
  bool poses_known = false;                   // else every sensor frame is taken for the body's
  std::vector<ImuEvidence> imus;              // those of which samples came, the body's first
  Duration deadline{0};                       // that the batcher is configured with
};

/** Listens to a rig: datagrams in the order of arrival, from a capture or live; 64 bytes stay of each lidar packet, and
 * all points of a few turns. */
class RigListener
{
 public:
  /** Time offsets of the configuration are applied as the batcher does. Throws what PacketRouter throws. */
  RigListener(const Rig&, bool poses_known);

  /** Throws what PacketRouter::route throws. */
  void add(const DatagramView&);
  void add(SocketAccount account) { evidence_.sockets = std::move(account); }

  RigEvidence finish();

 private:
  void addPacket(std::size_t lidar, const DatagramView&);

  std::vector<BatchedLidar> lidars_;
  std::vector<LidarAddress> addresses_;
  PacketRouter router_;
  SnapshotTaker snapshots_;
  std::vector<Duration> delays_;  // of each lidar's latest packet; 0 at first: wrapping stamps are near host time
  std::vector<MeasurementBlock> blocks_;
  RigEvidence evidence_;
};
}  // namespace scanloom
