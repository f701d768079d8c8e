/** Points of single turns of the lidars, taken at a few instants of a recording of any length. */
#pragma once
#include "calibration/CloudAgreement.h"
#include "diagnosis/internal/EvenSelection.h"
#include "input/lidar/PacketDecoder.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** One lidar's points of one turn, without those nearer than half a metre. `own` is known from SelfReturns.h on. */
struct Snapshot : SeenPoints
{
  std::uint64_t readings = 0;  // shots: channels times valid blocks
  std::uint64_t returns = 0;
};

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
