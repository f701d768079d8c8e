#include "mrpt_bridge/RigObservations.h"

#include <utility>

namespace scanloom
{
namespace
{
/** A scan follows the IMU samples of its period, so that the first sample may be later than the first scan's start. */
Timestamp beforeEverything(const std::optional<SensorEvent>& first, Duration period)
{
  if (!first) return {};
  if (const auto* scan = std::get_if<Scan>(&*first)) return scan->start;
  if (const auto* part = std::get_if<ScanPart>(&*first)) return part->scan.start;
  return std::get<SensorImu>(*first).sample.stamp - period;
}

/** Of a lidar whose sensor has not answered yet, only the pose is known. */
LidarDescription descriptionOf(const Rig& rig, LidarIndex lidar)
{
  if (rig.lidars[lidar].decoder) return rig.lidars[lidar].decoder->description();
  LidarDescription unknown;
  unknown.body_T_sensor = rig.sensors.at(lidar).body_T_sensor;
  return unknown;
}
}  // namespace

RecordingHeader recordingHeader(const Rig& rig)
{
  RecordingHeader header;
  header.scan_rate = rig.batcher.scan_rate;
  for (LidarIndex i = 0; i < rig.lidars.size(); ++i)
    header.lidars.push_back(recordedLidar(rig.lidars[i].name, descriptionOf(rig, i)));
  return header;
}

mrpt::obs::CObservation::Ptr toObservation(const SensorEvent& event, const Rig& rig, const DriverOptions& options)
{
  if (const auto* scan = std::get_if<Scan>(&event))
    return toObservation(*scan, cloudClassFromName(options.cloud_class), options.sensorLabel);
  if (const auto* part = std::get_if<ScanPart>(&event))
    return toObservation(part->scan, cloudClassFromName(options.cloud_class), options.sensorLabel + kSliceSuffix);

  const auto& imu = std::get<SensorImu>(event);
  if (imu.sensor == SensorImu::kBody) return toObservation(imu.sample, rig.body_T_imu, options.imu_label);

  const BatchedLidar& lidar = rig.lidars.at(static_cast<std::size_t>(imu.sensor));
  const LidarDescription& description = lidar.decoder->description();
  return toObservation(imu.sample, description.body_T_sensor * description.sensor_T_imu,
                       options.imu_label + "_" + lidar.name);
}

RigObservations::RigObservations(const Rig& rig, const DriverOptions& options) : rig_(rig), options_(options)
{
  cloudClassFromName(options_.cloud_class);
  input_ = openRig(rig_);
}

mrpt::obs::CObservation::Ptr RigObservations::next()
{
  if (!header_given_)
  {
    header_given_ = true;
    first_ = input_->next();
    input_->refresh(rig_);
    const RecordingHeader header = recordingHeader(rig_);
    return toObservation(header, beforeEverything(first_, header.period()));
  }
  const std::optional<SensorEvent> event = first_ ? std::exchange(first_, std::nullopt) : input_->next();
  input_->refresh(rig_);
  return event ? toObservation(*event, rig_, options_) : nullptr;
}
}  // namespace scanloom
