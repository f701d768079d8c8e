/** The datagrams of one lidar, packets and built-in IMU, as a recording computer gets them. */
#pragma once
#include "simulation/Scene.h"
#include "source/Datagram.h"

#include <cstddef>
#include <vector>

namespace scanloom
{
class PacketStream
{
 public:
  /** The scene and the station must outlive the stream. */
  PacketStream(const Scene&, const LidarStation&);

  /**
   * All datagrams that the sensor finished before `until` and that were not asked for yet, each receipt stamp after
   * the packet's last measurement. Columns are cast in parallel; the bytes do not depend on the number of threads.
   */
  std::vector<Datagram> finishedBefore(Timestamp until);

 private:
  Timestamp lastStampOf(std::uint64_t packet) const;
  Datagram lidarDatagram(std::uint64_t packet) const;
  Datagram imuDatagram(const ImuSample&, std::uint64_t index) const;
  Timestamp received(Timestamp measured, std::uint64_t index) const;

  const Scene& scene_;
  const LidarStation& station_;
  OusterEncoder encoder_;
  std::vector<ImuSample> imu_;
  std::uint64_t next_packet_ = 0;
  std::uint64_t next_imu_ = 0;
};
}  // namespace scanloom
