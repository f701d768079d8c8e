#include "run/run/internal/CalibrationDrive.h"

#include "base/core/Interruption.h"
#include "calibration/ScansOfDrive.h"
#include "estimation/imu/ImuScreening.h"

#include <algorithm>
#include <map>
#include <utility>

namespace scanloom
{
namespace
{
/** Only the columns of one lidar. */
Scan onlyOf(std::uint8_t lidar, const Scan& scan)
{
  Scan only;
  only.start = scan.start;
  only.period = scan.period;
  only.columns_of.assign(scan.columns_of.size(), 0);
  if (lidar < scan.columns_of.size()) only.columns_of[lidar] = scan.columns_of[lidar];
  only.missing[lidar] = scan.missing[lidar];
  std::vector<std::uint8_t> keep(scan.points.size(), 0);
  std::uint32_t points = 0;
  for (const Column& column : scan.columns)
  {
    if (column.sensor_id != lidar) continue;
    std::fill_n(keep.begin() + column.first_point, column.count, std::uint8_t{1});
    only.columns.push_back(column);
    only.columns.back().first_point = points;
    points += column.count;
  }
  only.points = scan.points;
  only.points.keep(keep);
  return only;
}

/** Hands on the scans of one lidar, with its IMU and the body's, and keeps those of all. */
class OneLidarInput final : public SensorInput
{
 public:
  OneLidarInput(SensorInput& input, std::size_t lidar, const Crop& crop, const std::optional<Extrinsics>& body_imu)
    : input_(input),
      lidar_(static_cast<std::uint8_t>(lidar)),
      crop_(crop),
      body_imu_(body_imu),
      scans_(mountedLidars(input.setup().header.lidars))
  {
  }

  std::optional<SensorEvent> next(Duration patience) override
  {
    std::optional<SensorEvent> event = input_.next(patience);
    if (event && std::holds_alternative<Scan>(*event))
    {
      const Scan scan = std::move(std::get<Scan>(*event));
      scans_.add(cropOut(scan, crop_).scan);
      return SensorEvent(onlyOf(lidar_, scan));
    }
    if (const auto* read = event ? std::get_if<SensorImu>(&*event) : nullptr)
    {
      ScreenedImu& imu = imus_[read->sensor];
      for (const ImuSample& sample : imu.screening.pass(read->sample)) imu.samples.push_back(sample);
    }
    return event;
  }
  bool ended() const override { return input_.ended(); }
  void stop() override { input_.stop(); }
  SensorSetup setup() const override
  {
    SensorSetup setup = input_.setup();
    for (std::size_t i = 0; i < setup.header.lidars.size(); ++i)
      if (i != lidar_) setup.body_T_imu.erase(static_cast<int>(i));
    if (body_imu_) setup.body_T_imu[SensorImu::kBody] = body_imu_->body_T_sensor;
    return setup;
  }
  double progress() const override { return input_.progress(); }
  RigAccount account() const override { return input_.account(); }
  std::map<std::string, StageTime> stages() const override { return input_.stages(); }
  std::vector<std::string> takeWarnings() override { return input_.takeWarnings(); }

  const std::vector<std::vector<LidarScan>>& scans() const { return scans_.byLidar(); }
  /** Of an IMU, by SensorImu::sensor, without what it cannot have read. */
  std::vector<ImuSample> imu(int sensor) const
  {
    const auto imu = imus_.find(sensor);
    return imu == imus_.end() ? std::vector<ImuSample>{} : imu->second.samples;
  }

 private:
  struct ScreenedImu
  {
    ImuScreening screening;
    std::vector<ImuSample> samples;
  };

  SensorInput& input_;
  std::uint8_t lidar_;
  Crop crop_;
  std::optional<Extrinsics> body_imu_;
  LidarScans scans_;
  std::map<int, ScreenedImu> imus_;
};

std::vector<LidarImu> lidarImus(const SensorSetup& setup, const OneLidarInput& input)
{
  const std::vector<MountedLidar> lidars = mountedLidars(setup.header.lidars);
  std::vector<LidarImu> imus(lidars.size());
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (const auto body_T_imu = setup.body_T_imu.find(static_cast<int>(i)); body_T_imu != setup.body_T_imu.end())
      imus[i] = {lidars[i].body_T_sensor.inverse() * body_T_imu->second, input.imu(static_cast<int>(i))};
  return imus;
}
}  // namespace

CalibrationDrive driveForCalibration(SensorInput& input, std::size_t reference, const SlamSettings& settings,
                                     const std::optional<Extrinsics>& body_imu, const KeepGoing& keepGoing,
                                     const Warn& warn)
{
  OneLidarInput one(input, reference, cropOf(settings.crop, mountedLidars(input.setup().header.lidars)), body_imu);
  SlamSettings in_use = settings;
  if (in_use.slam.imu != "none" && in_use.slam.imu != "body") in_use.slam.imu = "auto";  // another lidar's is not there
  if (body_imu) in_use.slam.imu_delay_ms = 1e3 * body_imu->clock_offset;
  CalibrationDrive drive;
  const SeeEstimate see = [&drive](const StateEstimate& estimate)
  {
    const auto add = [&drive](const StampedPose& pose)
    {
      if (drive.trajectory.empty() || drive.trajectory.back().stamp < pose.stamp) drive.trajectory.push_back(pose);
    };
    for (const StampedPose& pose : estimate.since_last) add(pose);
    add({estimate.stamp, estimate.map_T_body});
    if (estimate.registration && estimate.registration->outcome == Outcome::Converged && !estimate.recovered &&
        !estimate.map_restarted)
      drive.registered.push_back({estimate.stamp, estimate.registration->target_T_source});
  };
  drive.run = runSlam(one, in_use, see, keepGoing, warn);
  throwIfInterrupted();
  drive.scans = one.scans();
  drive.imu = one.imu(SensorImu::kBody);
  // Without an IMU the motion within a scan is not seen: the pose fits its middle.
  const std::vector<LidarScan>& own = drive.scans[reference];
  if (!drive.run.with_imu && !own.empty())
  {
    for (StampedPose& pose : drive.registered) pose.stamp -= own.front().period / 2;
    drive.trajectory = drive.registered;
  }
  drive.lidar_imus = lidarImus(input.setup(), one);
  return drive;
}

CalibrationDrive withoutOwnParts(CalibrationDrive drive, const std::vector<MountedLidar>& lidars)
{
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    const Eigen::Vector3d up_as_given = lidars[i].body_T_sensor.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    drive.scans[i] =
        withoutOwnParts(std::move(drive.scans[i]), drive.trajectory, upIn(drive.lidar_imus[i]).value_or(up_as_given));
  }
  return drive;
}

bool isPath(const CalibrationDrive& drive)
{
  constexpr double kMostBad = 0.05;
  const auto count = [&](const char* name) { return static_cast<double>(drive.run.summary.counts.at(name)); };
  const bool whole = drive.run.summary.error.empty() && count("map_restarts") == 0 && drive.trajectory.size() > 1;
  return whole && count("poses_degenerate") + count("poses_lost") <= kMostBad * count("poses");
}
}  // namespace scanloom
