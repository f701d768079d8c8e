/** The datagrams of all lidars of a scene in the order of receipt, simulated when they are asked for. */
#pragma once
#include "lab/simulation/internal/PacketStream.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace scanloom
{
class ScenePackets
{
 public:
  /** The scene must outlive it. */
  explicit ScenePackets(const Scene&);

  /** False at the end of the recording. Memory: a quarter of a second of packets. */
  bool next(Datagram&);

  /** Later datagrams are not received before this time. */
  Timestamp time() const { return settled_; }
  double share() const;  // of the recording, 0 to 1

  PacketCounts counts(std::size_t lidar) const { return streams_[lidar].counts(); }

 private:
  void simulateSlice();

  const Scene& scene_;
  std::vector<PacketStream> streams_;
  std::vector<Datagram> waiting_;  // in the order of receipt
  std::size_t next_ = 0;           // of `waiting_`
  Timestamp simulated_, settled_;
};
}  // namespace scanloom
