/** The datagrams of one lidar and its built-in IMU, as a recording computer receives them. */
#pragma once
#include "input/packets/Datagram.h"
#include "lab/simulation/internal/Scene.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace scanloom
{
/** What became of the packets of one lidar. */
struct PacketCounts
{
  std::uint64_t lidar = 0, imu = 0;  // arrived; duplicates count once
  std::uint64_t lost = 0, reordered = 0, duplicated = 0;
  ReturnCounts returns;  // of the packets that arrived
};

class PacketStream
{
 public:
  /** The scene and the station must outlive the stream. */
  PacketStream(const Scene&, const LidarStation&);

  /**
   * All datagrams whose last measurement is before `until` and that no earlier call returned. Columns are simulated in
   * parallel; the bytes do not depend on the number of threads.
   */
  std::vector<Datagram> finishedBefore(Timestamp until);

  const PacketCounts& counts() const { return counts_; }

 private:
  /** A packet that arrives, once or twice. */
  struct Transport
  {
    std::uint64_t packet;
    Timestamp received;
    std::optional<Timestamp> received_again;
  };

  const LidarRun& run() const { return station_.runs[run_]; }
  Timestamp finished(std::uint64_t packet) const;
  bool isSent(std::uint64_t packet) const;
  bool isLost(Timestamp sent, double luck) const;
  std::optional<Transport> transport(std::uint64_t packet);
  Datagram lidarDatagram(const Transport&, ReturnCounts&) const;
  Datagram imuDatagram(const std::vector<ImuStream::Sample>&, std::uint64_t index) const;
  void finishRun(Timestamp until, std::vector<Datagram>&);
  void addImu(Timestamp until, std::vector<Datagram>&);
  Duration delay(Random&, double packet_time) const;

  const Scene& scene_;
  const LidarStation& station_;
  std::size_t run_ = 0;
  std::vector<OusterEncoder> encoders_;           // by run
  std::vector<ImuStream> imus_;                   // by run
  std::vector<ImuStream::Sample> imu_waiting_;    // until their packet is full
  std::uint64_t next_packet_ = 0, next_imu_ = 0;  // of this run
  PacketCounts counts_;
};
}  // namespace scanloom
