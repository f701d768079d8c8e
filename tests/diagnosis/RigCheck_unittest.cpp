#include "diagnosis/RigCheck.h"

#include <gmock/gmock.h>

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "estimation/imu/AnalyticDrive.h"

namespace scanloom::rig_check_unittest
{
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1.2, 0.02, -0.01);

Rigid bodyAt(Timestamp stamp) { return AnalyticDrive().stateAt(stamp).map_T_imu * kBodyTImu.inverse(); }

/** A minute of registrations every `period`, and the IMU's samples as `change` makes them. */
template <typename Change>
RigFaults faultsOf(Change&& change, Duration period = 100ms, const Rigid& believed = kBodyTImu)
{
  RigMinute minute{{{0, {"the IMU", believed, believed}}}, {}, 0, {}, LidarCheck({})};
  for (ImuSample sample : AnalyticDrive().samples(Timestamp{9s}, Timestamp{71s}, 5ms))
  {
    change(sample);
    minute.samples[0].push_back(sample);
  }
  for (Timestamp from{10s}; from < Timestamp{70s}; from += period)
    minute.turns.push_back(
        {from, from + period, logSo3(bodyAt(from).rotation.conjugate() * bodyAt(from + period).rotation)});
  return rigFaults(minute);
}

std::string firstMend(const RigFaults& faults)
{
  return faults.faults.empty() ? "" : faults.faults.front().finding.mend;
}

/** 20 s on a floor without any tilt, with a corner of 90 deg in 3 s. */
std::vector<ImuSample> onAFloor(double gyro_scale)
{
  std::vector<ImuSample> samples;
  for (Timestamp stamp{0s}; stamp < Timestamp{20s}; stamp += 10ms)
  {
    const bool corner = stamp > Timestamp{10s} && stamp < Timestamp{13s};
    samples.push_back({stamp, Eigen::Vector3d(0, 0, corner ? 0.52 : 0) * gyro_scale, {0, 0, 9.81}});
  }
  return samples;
}
}  // namespace

TEST(RigCheck, hasNothingToSayOfAnImuThatAgrees)
{
  const RigFaults faults = faultsOf([](ImuSample&) {});
  EXPECT_THAT(faults.faults, IsEmpty());
  ASSERT_TRUE(faults.imu);
  EXPECT_LT(std::abs(seconds(faults.imu->lag)), 1e-3);
  EXPECT_LT(faults.imu->rotation.norm(), 0.01);
}

TEST(RigCheck, namesHowLateTheImusStampsAreAtEveryN)
{
  for (const Duration period : {100ms, 500ms, 1500ms})
    for (const Duration late : {50ms, -30ms})
    {
      const RigFaults faults = faultsOf([&](ImuSample& s) { s.stamp += late; }, period);
      ASSERT_TRUE(faults.imu);
      EXPECT_NEAR(seconds(faults.imu->lag), seconds(late), 2e-3) << seconds(period);
    }
  EXPECT_THAT(firstMend(faultsOf([](ImuSample& s) { s.stamp += 50ms; })), HasSubstr("imu_delay_ms = 50"));
}

TEST(RigCheck, namesByHowMuchTheImusPoseIsTurned)
{
  const Rigid turned = Rigid::fromXyzYawPitchRoll(0, 0, 0, M_PI / 2, 0, 0) * kBodyTImu;
  EXPECT_THAT(firstMend(faultsOf([](ImuSample&) {}, 100ms, turned)), HasSubstr("turn it by 90.0 deg"));
}

TEST(RigCheck, namesAGyroscopeInDegreesAndALeftHandedOne)
{
  EXPECT_THAT(firstMend(faultsOf([](ImuSample& s) { s.gyro *= 180 / M_PI; })), HasSubstr("in deg/s"));
  EXPECT_THAT(firstMend(faultsOf([](ImuSample& s) { s.gyro *= M_PI / 180; })), HasSubstr("57.2958"));
  EXPECT_THAT(firstMend(faultsOf([](ImuSample& s) { s.gyro *= -1; })), HasSubstr("left-handed"));
}

TEST(RigCheck, namesAGyroscopeInDegreesOnAFloorWithoutTiltAndWithoutARegistration)
{
  RigMinute minute{{{0, {"the IMU", {}, {}}}}, {{0, onAFloor(1 / kDegree)}}, 0, {}, LidarCheck({})};
  EXPECT_THAT(firstMend(rigFaults(minute)), HasSubstr("in deg/s"));
  minute.samples[0] = onAFloor(1);
  EXPECT_THAT(rigFaults(minute).faults, IsEmpty());
}

TEST(RigCheck, namesAPoseWhoseAnglesAreInRadians)
{
  const Rigid true_pose = Rigid::fromXyzYawPitchRoll(1, 0, 2, 30 * kDegree, 15 * kDegree, -25 * kDegree);
  const Rigid read = Rigid::fromXyzYawPitchRoll(1, 0, 2, 0.5236 * kDegree, 0.2618 * kDegree, -0.4363 * kDegree);
  const ImuSample at_rest{{}, Eigen::Vector3d::Zero(), true_pose.rotation.conjugate() * Eigen::Vector3d(0, 0, 9.81)};
  std::vector<ImuSample> samples(3000, at_rest);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].stamp = Timestamp(10ms * static_cast<int>(i));
  RigMinute minute{{{0, {"the IMU of the lidar 'left'", read, read}}}, {{0, samples}}, {}, {}, LidarCheck({})};
  EXPECT_THAT(firstMend(rigFaults(minute)), HasSubstr("give 30.0 15.0 -25.0 deg"));
  minute.imus[0] = {"the IMU of the lidar 'left'", true_pose, true_pose};
  EXPECT_THAT(rigFaults(minute).faults, IsEmpty());
}

TEST(RigCheck, leavesOutReadingsThatAreNotFinite)
{
  std::vector<std::string> warnings;
  const Warn warn = [&](const std::string& warning) { warnings.push_back(warning); };
  RigCheck check({}, {{0, {"the IMU", {}, {}}}}, 0, warn);
  int number = 0;
  for (ImuSample sample : onAFloor(1))
  {
    if (++number % 10 == 0) sample.gyro.x() = std::nan("");
    check.add(0, sample);
  }
  check.finish();
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(RigCheck, warnsOnceAndFiveSecondsAfterItLookedHoweverFastItIs)
{
  std::vector<std::string> warnings;
  const Warn warn = [&](const std::string& warning) { warnings.push_back(warning); };
  RigCheck check({}, {{0, {"the IMU", {}, {}}}}, 0, warn);
  std::optional<Timestamp> told;
  for (const ImuSample& sample : onAFloor(1 / kDegree)) check.add(0, sample);
  for (Timestamp stamp{0s}; stamp < Timestamp{60s}; stamp += 100ms)
  {
    check.add(LocalisedScan{stamp, std::nullopt, nullptr});
    if (!told && !warnings.empty()) told = stamp;
  }
  check.finish();
  EXPECT_EQ(told, Timestamp{20s}) << "looked at 15 s";
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(check.warned());
}
}  // namespace scanloom::rig_check_unittest
