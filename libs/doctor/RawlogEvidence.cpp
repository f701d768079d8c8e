#include "doctor/RawlogEvidence.h"

#include "mrpt_bridge/RawlogReader.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
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
        fmt::format("{}: the first object is not scanloom's header, so its lidars are unknown: record it with scanloom",
                    path.string()));
  RawlogEvidence evidence;
  evidence.rig.poses_known = true;
  evidence.rig.packets_known = false;
  for (const RecordedLidar& lidar : reader.header()->lidars) evidence.rig.lidars.push_back(lidarOf(lidar));

  EvenSelection<RigSnapshot> snapshots;
  std::int64_t scans = 0;
  while (std::optional<RecordedEvent> event = reader.next())
  {
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
      imuNamed(evidence.rig.imus, *imu).samples.push_back(imu->sample);
    else if (const auto* recorded = std::get_if<RecordedScan>(&*event))
      if (RigSnapshot* snapshot = snapshots.at(scans++))
        *snapshot = snapshotOf(recorded->scan, evidence.rig.lidars.size());
  }
  evidence.rig.snapshots = std::move(snapshots).taken();
  evidence.damage = reader.damage();
  return evidence;
}
}  // namespace scanloom
