#include "diagnosis/internal/Snapshots.h"

#include <utility>

namespace scanloom
{
namespace
{
constexpr int kTurnsApart = 10;               // at first: 1 s
constexpr std::uint32_t kNearestRange = 500;  // mm: anything nearer is dirt or the sensor's cover
}  // namespace

SnapshotTaker::SnapshotTaker(std::size_t lidars, Duration turn) : lidars_(lidars), turn_(turn) {}

void SnapshotTaker::add(std::size_t lidar, const PacketDecoder& decoder, Bytes packet,
                        const std::vector<MeasurementBlock>& blocks, Timestamp received)
{
  if (!start_) start_ = received;
  const Duration interval = kTurnsApart * turn_;
  const std::int64_t number = (received - *start_) / interval;
  if (received - *start_ - number * interval >= turn_) return;
  RigSnapshot* snapshots = snapshots_.at(number);
  if (!snapshots) return;
  snapshots->resize(lidars_);
  Snapshot& snapshot = (*snapshots)[lidar];

  PointCloud& points = snapshot.points;
  const std::size_t before = points.size();
  for (const MeasurementBlock& block : blocks)
  {
    if (!block.valid) continue;
    decoder.appendPoints(packet, block.index, 0, static_cast<std::uint8_t>(lidar), points);
    snapshot.readings += static_cast<std::uint64_t>(decoder.description().channels);
  }
  snapshot.returns += points.size() - before;
  std::vector<std::uint8_t> keep(points.size(), 1);
  for (std::size_t i = before; i < points.size(); ++i) keep[i] = points.range[i] >= kNearestRange ? 1 : 0;
  points.keep(keep);
}

std::vector<RigSnapshot> SnapshotTaker::finish() { return std::move(snapshots_).taken(); }
}  // namespace scanloom
