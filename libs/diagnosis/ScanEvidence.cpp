#include "diagnosis/ScanEvidence.h"

#include <map>

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

Rigid configuredPose(int sensor, const SensorSetup& setup)
{
  return sensor == SensorImu::kBody ? setup.body_T_imu.at(sensor)
                                    : setup.header.lidars.at(static_cast<std::size_t>(sensor)).body_T_sensor;
}

std::string nameOf(int sensor, const std::vector<LidarEvidence>& lidars)
{
  return sensor == SensorImu::kBody ? "imu" : "imu_" + lidars.at(static_cast<std::size_t>(sensor)).name;
}
}  // namespace

RigEvidence scanEvidence(SensorInput& input, bool poses_known, const std::function<bool()>& keep_reading)
{
  RigEvidence evidence;
  evidence.poses_known = poses_known;
  evidence.packets_known = false;
  for (const RecordedLidar& lidar : input.setup().header.lidars) evidence.lidars.push_back(lidarOf(lidar));

  EvenSelection<RigSnapshot> snapshots;
  std::map<int, std::vector<ImuSample>> samples;  // by sensor: the body's first
  std::int64_t scans = 0;
  while (keep_reading())
  {
    const std::optional<SensorEvent> event = input.next();
    if (!event) break;
    if (const auto* imu = std::get_if<SensorImu>(&*event))
      samples[imu->sensor].push_back(imu->sample);
    else if (const auto* scan = std::get_if<Scan>(&*event))
      if (RigSnapshot* snapshot = snapshots.at(scans++)) *snapshot = snapshotOf(*scan, evidence.lidars.size());
  }
  evidence.snapshots = std::move(snapshots).taken();
  const SensorSetup setup = input.setup();
  for (auto& [sensor, of_imu] : samples)
    evidence.imus.push_back({nameOf(sensor, evidence.lidars), std::move(of_imu), setup.body_T_imu.at(sensor),
                             configuredPose(sensor, setup)});
  return evidence;
}
}  // namespace scanloom
