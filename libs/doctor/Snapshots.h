/** Points of single turns of the lidars, taken at a few instants of a recording of any length. */
#pragma once
#include "core/PointCloud.h"
#include "doctor/EvenSelection.h"
#include "lidar/PacketDecoder.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** One lidar's points of one turn in the body frame, without those nearer than half a metre. */
struct Snapshot
{
  PointCloud points;
  std::vector<std::uint8_t> own;  // 1 where a point is on the machine itself (OwnParts.h); empty: not known
  std::uint64_t readings = 0;     // shots: channels times valid blocks
  std::uint64_t returns = 0;
};

/** The points without those known to be on the machine itself. */
PointCloud surroundings(const Snapshot&);

/** Snapshots of all lidars from the same time, by the lidar's index. */
using RigSnapshot = std::vector<Snapshot>;

/** Takes snapshots of one turn at equal intervals, twelve at most (EvenSelection). */
class SnapshotTaker
{
 public:
  SnapshotTaker(std::size_t lidars, Duration turn);

  /** `packet` must be of PacketKind::Lidar and `received` must not go back; `blocks` are the packet's. */
  void add(std::size_t lidar, const PacketDecoder&, Bytes packet, const std::vector<MeasurementBlock>& blocks,
           Timestamp received);

  /** In time order. */
  std::vector<RigSnapshot> finish();

 private:
  std::size_t lidars_;
  Duration turn_;
  std::optional<Timestamp> start_;
  EvenSelection<RigSnapshot> snapshots_;  // by the number of the interval since the start
};
}  // namespace scanloom
