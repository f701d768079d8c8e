#include "mrpt/edit/internal/ApplyExtrinsics.h"

#include "base/core/ConfigError.h"
#include "input/rawlogs/Conversions.h"
#include "input/rig/Extrinsics.h"
#include "input/rig/RigOptions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogReader.h"

#include <mrpt/obs/CObservationIMU.h>

namespace scanloom
{
namespace
{
using mrpt::obs::CObservationPointCloud;

const std::string kBodyPrefix = "T_body_";

SensorPoses fromExtrinsics(const std::filesystem::path& path)
{
  SensorPoses poses;
  for (const auto& [name, pose] : readExtrinsics(path))
    if (name.compare(0, kBodyPrefix.size(), kBodyPrefix) == 0) poses[name.substr(kBodyPrefix.size())] = pose;
  return poses;
}

SensorPoses fromConfiguration(const std::filesystem::path& path)
{
  Configuration configuration = Configuration::fromFiles({path});
  makeRigPathsAbsolute(configuration);
  const RigSettings settings = readRigSettings(configuration, rigSection(configuration));
  SensorPoses poses;
  if (!settings.rig.extrinsics.empty()) poses = fromExtrinsics(settings.rig.extrinsics);
  for (const LidarOptions& lidar : settings.lidars)
    if (!lidar.pose.empty()) poses[lidar.name] = parsePose(lidar.pose);
  if (!settings.rig.imu_pose.empty()) poses[kImuLabel] = parsePose(settings.rig.imu_pose);
  return poses;
}

/** Changes the poses of sensors in headers, clouds and IMU samples. */
class Remount
{
 public:
  Remount(SensorPoses poses, RecordingHeader header)
    : poses_(std::move(poses)), before_(header), after_(std::move(header))
  {
    bool any = poses_.count(kImuLabel) > 0;
    for (RecordedLidar& lidar : after_.lidars)
      if (const auto found = poses_.find(lidar.name); found != poses_.end())
      {
        lidar.body_T_sensor = found->second;
        any = true;
      }
    if (!any) throw UsageError("--apply-extrinsics: none of the poses is that of a sensor of this rawlog");
  }

  Observations operator()(const ObservationPtr& observation) const
  {
    if (!observation) return {};
    if (headerIn(*observation)) return {withHeader(*observation, after_)};
    if (auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(observation)) return {moved(imu)};
    const auto cloud = cloudIn(observation);
    return {cloud ? moved(*cloud) : observation};
  }

 private:
  Rigid newTOld(std::size_t lidar) const
  {
    return after_.lidars[lidar].body_T_sensor * before_.lidars[lidar].body_T_sensor.inverse();
  }

  bool hasNewPose(std::size_t lidar) const { return poses_.count(before_.lidars[lidar].name) > 0; }

  ObservationPtr moved(const std::shared_ptr<mrpt::obs::CObservationIMU>& imu) const
  {
    const auto part = partOf(imu->sensorLabel, before_);
    const auto body = poses_.find(kImuLabel);
    if (part && hasNewPose(part->lidar))
      imu->sensorPose = toMrpt(newTOld(part->lidar) * fromMrpt(imu->sensorPose));
    else if (imu->sensorLabel == kImuLabel && body != poses_.end())
      imu->sensorPose = toMrpt(body->second);
    return imu;
  }

  ObservationPtr moved(const CObservationPointCloud& cloud) const
  {
    const auto ids = sensorIdsOf(cloud, before_);
    std::vector<Rigid> new_T_old;
    for (std::size_t lidar = 0; lidar < before_.lidars.size(); ++lidar) new_T_old.push_back(newTOld(lidar));
    std::vector<Eigen::Vector3f> points = positionsInBody(cloud);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (hasNewPose(ids[i])) points[i] = (new_T_old[ids[i]] * points[i].cast<double>().eval()).cast<float>();
    return withPositions(cloud, points);
  }

  SensorPoses poses_;
  RecordingHeader before_, after_;
};
}  // namespace

SensorPoses readSensorPoses(const std::filesystem::path& path)
{
  return path.extension() == ".ini" ? fromConfiguration(path) : fromExtrinsics(path);
}

RawlogOperation applyExtrinsics(const SensorPoses& poses, const RecordingHeader& header)
{
  return Remount(poses, header);
}
}  // namespace scanloom
