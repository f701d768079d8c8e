#include "dataset/Snapshots.h"

namespace scanloom
{
namespace
{
constexpr std::size_t kMostSnapshots = 12;
constexpr int kTurnsApart = 10;               // at first: 1 s
constexpr std::uint32_t kNearestRange = 500;  // mm: what is nearer is dirt, or the sensor's own cover
}  // namespace

PointCloud surroundings(const Snapshot& snapshot)
{
  PointCloud points = snapshot.points;
  if (snapshot.own.empty()) return points;
  std::vector<std::uint8_t> keep;
  for (const std::uint8_t own : snapshot.own) keep.push_back(own ? 0 : 1);
  points.keep(keep);
  return points;
}

SnapshotTaker::SnapshotTaker(std::size_t lidars, Duration turn)
  : lidars_(lidars), turn_(turn), interval_(kTurnsApart * turn)
{
}

void SnapshotTaker::add(std::size_t lidar, const PacketDecoder& decoder, Bytes packet,
                        const std::vector<MeasurementBlock>& blocks, Timestamp received)
{
  if (!start_) start_ = received;
  std::int64_t number = (received - *start_) / interval_;
  if (received - *start_ - number * interval_ >= turn_) return;
  if (snapshots_.count(number) == 0 && snapshots_.size() == kMostSnapshots)
  {
    makeRoom();
    if (number % 2 != 0) return;
    number /= 2;
  }
  RigSnapshot& snapshot = snapshots_.try_emplace(number, lidars_).first->second;

  PointCloud& points = snapshot[lidar].points;
  const std::size_t before = points.size();
  for (const MeasurementBlock& block : blocks)
  {
    if (!block.valid) continue;
    decoder.appendPoints(packet, block.index, 0, static_cast<std::uint8_t>(lidar), points);
    snapshot[lidar].readings += static_cast<std::uint64_t>(decoder.description().channels);
  }
  snapshot[lidar].returns += points.size() - before;
  // The near ones are overwritten by those that follow.
  std::vector<std::uint8_t> keep(points.size(), 1);
  for (std::size_t i = before; i < points.size(); ++i) keep[i] = points.range[i] >= kNearestRange ? 1 : 0;
  points.keep(keep);
}

void SnapshotTaker::makeRoom()
{
  std::map<std::int64_t, RigSnapshot> kept;
  for (auto& [number, snapshot] : snapshots_)
    if (number % 2 == 0) kept[number / 2] = std::move(snapshot);
  snapshots_ = std::move(kept);
  interval_ *= 2;
}

std::vector<RigSnapshot> SnapshotTaker::finish()
{
  std::vector<RigSnapshot> in_order;
  for (auto& [number, snapshot] : snapshots_) in_order.push_back(std::move(snapshot));
  return in_order;
}
}  // namespace scanloom
