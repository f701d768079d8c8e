/** What the path of a drive for calibration is made of. */
#include "run/run/internal/CalibrationDrive.h"

#include "estimation/slam/StandOfStems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace scanloom::calibration_drive_unittest
{
namespace
{
constexpr int kLeft = 0, kRight = 1;

/** Three seconds of two lidars at rest in a stand: 'right' sees it, 'left' has the only IMU. */
class ImuBesideTheReference final : public SensorInput
{
 public:
  ImuBesideTheReference()
  {
    setup_.header.lidars.resize(2);
    setup_.header.lidars[kLeft].name = "left";
    setup_.header.lidars[kRight].name = "right";
    setup_.header.lidars[kRight].body_T_sensor = Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0);
    setup_.body_T_imu[kLeft] = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, M_PI / 2);
    Scan scan = StandOfStems().scanAt(Timestamp{0ms}, [](Timestamp) { return Rigid::identity(); });
    std::fill(scan.points.sensor_id.begin(), scan.points.sensor_id.end(), kRight);
    for (Column& column : scan.columns) column.sensor_id = kRight;
    for (int i = 0; i < 30; ++i, scan.start += 100ms)
    {
      for (Duration t{0}; t < 100ms; t += 5ms)
      {
        const double noise = 1e-4 * std::sin(seconds(scan.start.time_since_epoch() + t) * 700);  // no constant reading
        events_.push_back(SensorImu{kLeft, {scan.start + t, {noise, 0, 0}, {0, noise, 9.80665}}});
      }
      events_.push_back(scan);
      for (Column& column : scan.columns) column.stamp += 100ms;
    }
  }

  std::optional<SensorEvent> next(Duration) override
  {
    std::optional<SensorEvent> event(std::move(events_.front()));
    events_.pop_front();
    return event;
  }
  bool ended() const override { return events_.empty(); }
  void stop() override {}
  SensorSetup setup() const override { return setup_; }

 private:
  SensorSetup setup_;
  std::deque<SensorEvent> events_;
};
}  // namespace

TEST(CalibrationDrive, doesNotGoByTheImuOfALidarWhosePoseIsSought)
{
  ImuBesideTheReference input;
  const CalibrationDrive drive = driveForCalibration(
      input, kRight, {}, std::nullopt, [](const RunProgress&) { return true; }, [](const std::string&) {});
  EXPECT_FALSE(drive.run.with_imu);
  ASSERT_FALSE(drive.trajectory.empty());
  EXPECT_LT(drive.trajectory.back().map_T_body.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.02);
  EXPECT_FALSE(drive.lidar_imus[kLeft].samples.empty());
}
}  // namespace scanloom::calibration_drive_unittest
