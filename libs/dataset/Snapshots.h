/** What the lidars saw in a few short whiles, spread over a recording of any length. */
#pragma once
#include "core/PointCloud.h"
#include "lidar/PacketDecoder.h"

#include <map>
#include <optional>
#include <vector>

namespace scanloom
{
/** One lidar's points of one turn in the body frame, none nearer than half a metre. */
struct Snapshot
{
  PointCloud points;
  std::vector<std::uint8_t> own;  // 1 where a point is the machine's (OwnParts.h); empty: not known
  std::uint64_t readings = 0;     // channels times blocks: what a full turn in the open could have returned
  std::uint64_t returns = 0;
};

/** Without the points that are known to be the machine's. */
PointCloud surroundings(const Snapshot&);

/** The same while seen by every lidar: the place in the list is the lidar's. */
using RigSnapshot = std::vector<Snapshot>;

/**
 * Keeps at most twelve whiles of one turn, at equal intervals. It does not need to know how long the recording is: when
 * there are more, every other one is dropped and the interval doubled.
 */
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
  void makeRoom();

  std::size_t lidars_;
  Duration turn_;
  Duration interval_;
  std::optional<Timestamp> start_;
  std::map<std::int64_t, RigSnapshot> snapshots_;  // by number of the interval
};
}  // namespace scanloom
