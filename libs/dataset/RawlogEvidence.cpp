#include "dataset/RawlogEvidence.h"

#include <fmt/format.h>

#include "mrpt_bridge/RawlogReader.h"

namespace scanloom
{
namespace
{
constexpr std::size_t kMostScans = 12;

/** At most so many scans at equal intervals, of a recording whose length nobody knows. */
class EvenlyTaken
{
 public:
  void add(Scan scan)
  {
    if (seen_++ % every_ != 0) return;
    if (scans_.size() == kMostScans)
    {
      std::vector<Scan> kept;
      for (std::size_t i = 0; i < scans_.size(); i += 2) kept.push_back(std::move(scans_[i]));
      scans_ = std::move(kept);
      every_ *= 2;
      if ((seen_ - 1) % every_ != 0) return;
    }
    scans_.push_back(std::move(scan));
  }

  const std::vector<Scan>& scans() const { return scans_; }

 private:
  std::vector<Scan> scans_;
  std::size_t seen_ = 0, every_ = 1;
};

RigSnapshot snapshotOf(const Scan& scan, std::size_t lidars)
{
  RigSnapshot snapshot(lidars);
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (scan.points.sensor_id[i] < lidars) snapshot[scan.points.sensor_id[i]].points.append(scan.points, i);
  return snapshot;
}

ImuEvidence& imuNamed(std::vector<ImuEvidence>& imus, const RecordedImu& recorded)
{
  for (ImuEvidence& imu : imus)
    if (imu.name == recorded.label) return imu;
  imus.push_back({recorded.label, {}, recorded.body_T_imu});
  return imus.back();
}

LidarEvidence lidarOf(const RecordedLidar& recorded)
{
  LidarEvidence evidence;
  evidence.name = recorded.name;
  evidence.lidar.model = recorded.model;
  evidence.lidar.serial = recorded.serial;
  evidence.lidar.channels = recorded.beams;
  evidence.lidar.columns_per_frame = recorded.columns;
  evidence.lidar.body_T_sensor = recorded.body_T_sensor;
  evidence.lidar.clock = recorded.clock;
  return evidence;
}
}  // namespace

RawlogEvidence rawlogEvidence(const std::filesystem::path& path)
{
  RawlogReader reader(path);
  if (!reader.header())
    throw std::runtime_error(
        fmt::format("{}: its first object is not scanloom's header, so nothing is known of its "
                    "lidars: record it with scanloom",
                    path.string()));
  RawlogEvidence evidence;
  evidence.rig.poses_known = true;
  evidence.rig.packets_known = false;
  for (const RecordedLidar& lidar : reader.header()->lidars) evidence.rig.lidars.push_back(lidarOf(lidar));

  EvenlyTaken taken;
  while (std::optional<RecordedEvent> event = reader.next())
  {
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
      imuNamed(evidence.rig.imus, *imu).samples.push_back(imu->sample);
    else if (auto* scan = std::get_if<RecordedScan>(&*event))
      taken.add(std::move(scan->scan));
  }
  for (const Scan& scan : taken.scans()) evidence.rig.snapshots.push_back(snapshotOf(scan, evidence.rig.lidars.size()));
  evidence.damage = reader.damage();
  return evidence;
}
}  // namespace scanloom
