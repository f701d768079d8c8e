#include "estimation/slam/LidarInertialSlam.h"

#include <gtest/gtest.h>

#include "GentleMachine.h"
#include "StandOfStems.h"
#include "base/core/Angle.h"
#include "base/core/Decompositions.h"
#include "estimation/ndt/RayWorld.h"
#include "estimation/slam/PriorMap.h"

namespace scanloom::lidar_inertial_slam_unittest
{
namespace
{
struct Driven
{
  std::vector<StateEstimate> estimates;
  std::uint64_t skipped = 0, recoveries = 0, map_restarts = 0, searches = 0;

  const StateEstimate& at(Duration t) const { return estimates[static_cast<std::size_t>(t / 100ms - 2)]; }
};

using ChangeScan = std::function<void(Scan&)>;
using ChangeImu = std::function<void(ImuSample&)>;

Driven runFor(
    const Machine& machine, Duration length, const SlamSettings& settings = {}, const ChangeScan& change = [](Scan&) {},
    const ChangeImu& changeImu = [](ImuSample&) {})
{
  const StandOfStems stand;
  LidarInertialSlam slam(withMachineBox(settings), kBodyTImu, {{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}});
  Driven run;
  const auto keep = [&run](std::vector<StateEstimate> more)
  { std::move(more.begin(), more.end(), std::back_inserter(run.estimates)); };
  Timestamp imu{0ms};
  for (Timestamp start{100ms}; start + 100ms <= Timestamp{length}; start += 100ms)
  {
    for (; imu <= start + 105ms; imu += 5ms)
    {
      ImuSample sample = machine.sampleAt(imu);
      changeImu(sample);
      slam.addImu(sample);
    }
    Scan scan = stand.scanAt(start, [&](Timestamp t) { return machine.bodyAt(t); });
    change(scan);
    keep(slam.addScan(std::move(scan)));
  }
  keep(slam.finish());
  run.skipped = slam.skippedScans();
  run.recoveries = slam.recoveries();
  run.map_restarts = slam.mapRestarts();
  const auto& stages = slam.times().stages();
  if (const auto search = stages.find("relocalisation"); search != stages.end()) run.searches = search->second.runs;
  return run;
}

void blind(Scan& scan)
{
  scan.columns.clear();
  scan.points.clear();
}

ChangeScan blindFrom(Timestamp from, Timestamp to)
{
  return [=](Scan& scan)
  {
    if (scan.start >= from && scan.start < to) blind(scan);
  };
}

/** An IMU that is wrong for some time. */
ChangeImu wrongFrom(Timestamp from, Timestamp to, const ChangeImu& change)
{
  return [=](ImuSample& sample)
  {
    if (sample.stamp >= from && sample.stamp < to) change(sample);
  };
}

/** 1.5 m/s from the first reading on. */
Machine movingMachine()
{
  Machine machine = gentleMachine(0s);
  machine.drive.x = {0, 1.5, 0, 1, 0};
  return machine;
}

Rigid worldTMap(const Driven& run, const Machine& machine)
{
  // The map frame is the body's at the start, levelled: fixed by the first pose.
  return machine.bodyAt(run.estimates.front().stamp) * run.estimates.front().map_T_body.inverse();
}

double largestError(const Driven& run, const Machine& machine)
{
  const Rigid world_T_map = worldTMap(run, machine);
  double largest = 0;
  for (const StateEstimate& e : run.estimates)
    largest =
        std::max(largest, ((world_T_map * e.map_T_body).translation - machine.bodyAt(e.stamp).translation).norm());
  return largest;
}
}  // namespace

TEST(LidarInertialSlam, followsAMachineThatStartsFromRest)
{
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 12s);
  ASSERT_EQ(run.estimates.size(), 119u);
  EXPECT_LT(largestError(run, machine), 0.03);
  for (const StateEstimate& e : run.estimates) EXPECT_EQ(e.health, Health::Ok);
}

TEST(LidarInertialSlam, theFirstAttitudeIsLevelledByGravity)
{
  Machine machine = gentleMachine(3s);
  machine.drive.pitch.offset = 0.1;
  const Driven run = runFor(machine, 3s);
  const Eigen::Vector3d up_in_body = machine.bodyAt(Timestamp{1s}).rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((run.estimates.back().map_T_body.rotation * up_in_body - Eigen::Vector3d::UnitZ()).norm(), 2e-3);
  EXPECT_LT(run.estimates.back().map_T_body.translation.norm(), 0.01);
}

TEST(LidarInertialSlam, aStartWhileMovingIsMarkedAndFollows)
{
  const Machine machine = movingMachine();
  const Driven run = runFor(machine, 8s);
  EXPECT_EQ(run.estimates.front().health, Health::Initialising);
  EXPECT_EQ(run.estimates.back().health, Health::Ok);
  EXPECT_LT(largestError(run, machine), 0.15);
}

namespace
{
/** A wall beside the lidar that moves with the machine. */
void addOwnWall(Scan& scan)
{
  PointCloud points;
  for (Column& column : scan.columns)
  {
    const std::uint32_t first = column.first_point, end = first + column.count;
    column.first_point = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = first; i < end; ++i) points.append(scan.points, i);
    for (int i = 0; i < 200; ++i)
    {
      points.append(scan.points, first);
      points.x.back() = -8 + 0.25f * static_cast<float>(column.measurement_id);
      points.y.back() = column.measurement_id % 2 == 0 ? 2.5f : -2.5f;
      points.z.back() = 0.02f * static_cast<float>(i);
    }
    column.count = static_cast<std::uint16_t>(points.size() - column.first_point);
  }
  scan.points = std::move(points);
}
}  // namespace

TEST(LidarInertialSlam, theVelocityOfTheStartDoesNotDependOnPointsInALidarsOwnBox)
{
  const Machine machine = movingMachine();
  SlamSettings settings;
  settings.crop.lidar_boxes = "left -9 2.4 -4 9 2.6 2, left -9 -2.6 -4 9 -2.4 2";
  const Driven with_wall = runFor(machine, 3s, settings, addOwnWall), without = runFor(machine, 3s, settings);
  EXPECT_EQ(with_wall.estimates.front().velocity, without.estimates.front().velocity);
}

TEST(LidarInertialSlam, everyStampIsTheEndOfAScan)
{
  const Driven run = runFor(gentleMachine(3s), 4s);
  for (std::size_t i = 0; i < run.estimates.size(); ++i)
    EXPECT_EQ(run.estimates[i].stamp, Timestamp{200ms} + 100ms * static_cast<std::int64_t>(i));
}

TEST(LidarInertialSlam, everyNthScanIsEnoughBecauseTheImuRunsOn)
{
  SlamSettings settings;
  settings.slam.every_nth = 10;
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 12s, settings);
  EXPECT_EQ(run.estimates.size(), 12u);
  EXPECT_EQ(run.skipped, 107u);
  EXPECT_LT(largestError(run, machine), 0.05);
}

TEST(LidarInertialSlam, aStandingMachineStaysWhereTheLidarSeesItIfItsAccelerometerChanges)
{
  SlamSettings settings;
  settings.slam.every_nth = 5;
  settings.slam.trust.contradiction = 0;  // the stand has no noise: 2 mm are many standard deviations
  const Driven run = runFor(
      gentleMachine(100s), 30s, settings, [](Scan&) {},
      wrongFrom(Timestamp{5s}, Timestamp::max(), [](ImuSample& sample) { sample.accel.x() += 0.02; }));  // m/s2
  for (const StateEstimate& e : run.estimates)
    EXPECT_LT(e.map_T_body.translation.norm(), 0.025) << seconds(e.stamp.time_since_epoch()) << " s";
}

TEST(LidarInertialSlam, posesBetweenScansComeAtTheImusRateAndEndAtTheEstimate)
{
  const Driven run = runFor(gentleMachine(3s), 6s);
  const StateEstimate& e = run.estimates.back();
  EXPECT_GE(e.since_last.size(), 20u);
  EXPECT_EQ(e.since_last.back().stamp, e.stamp);
  EXPECT_LT((e.since_last.back().map_T_body.translation - e.map_T_body.translation).norm(), 1e-9);
}

TEST(LidarInertialSlam, timesOfPointsCountFromTheEstimatesStamp)
{
  for (const StateEstimate& e : runFor(gentleMachine(3s), 4s).estimates)
  {
    EXPECT_GE(*std::min_element(e.cloud.t.begin(), e.cloud.t.end()), -100'000'000) << "the scan's first column";
    EXPECT_LT(*std::max_element(e.cloud.t.begin(), e.cloud.t.end()), 0);
  }
}

TEST(LidarInertialSlam, aKeyframeIsAddedEveryFourMetres)
{
  const Driven run = runFor(gentleMachine(3s), 14s);
  std::vector<Eigen::Vector3d> places;
  for (const StateEstimate& e : run.estimates)
    if (e.keyframe) places.push_back(e.keyframe->map_T_body.translation);
  ASSERT_GE(places.size(), 3u);
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_NEAR((places[i] - places[i - 1]).norm(), 4.1, 0.2);
}

TEST(LidarInertialSlam, aBlindBodyIsSoonCalledLostAndCarriedOnAsLongAsTheImuKnowsItsVelocity)
{
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 34s, {}, blindFrom(Timestamp{6s}, Timestamp{30s}));
  ASSERT_EQ(run.estimates.size(), 339u);
  EXPECT_EQ(run.at(7s).health, Health::Degenerate);
  EXPECT_EQ(run.at(10s).health, Health::Lost);
  EXPECT_EQ(run.at(29s).health, Health::Lost);
  EXPECT_GT(run.at(29s).velocity.norm(), 0.1);
  EXPECT_LT(largestError(run, machine), 0.5);
  EXPECT_EQ(run.estimates.back().health, Health::Ok);
  EXPECT_EQ(run.map_restarts, 0u);
}

TEST(LidarInertialSlam, whatIsLeftOfAScanWhenASilenceEndsIsNoKeyframe)
{
  const Machine machine = movingMachine();
  const Timestamp from{5s}, to{9s};
  const Driven run = runFor(machine, 10s, {},
                            [&](Scan& scan)
                            {
                              if (scan.start >= from && scan.start < to) blind(scan);
                              if (scan.start != to) return;
                              scan.columns.resize(4);
                              scan.points.resize(scan.columns.back().first_point + scan.columns.back().count);
                            });
  const StateEstimate &part = run.at(9100ms), &whole = run.at(9200ms);
  EXPECT_LT(part.cloud.size(), whole.cloud.size() / 10);
  EXPECT_EQ(part.health, Health::Ok) << "its place is known, 6 m from the last keyframe";
  EXPECT_FALSE(part.keyframe);
  EXPECT_TRUE(whole.keyframe);
}

TEST(LidarInertialSlam, aLostBodyComesToRestAndIsFoundAgainWhenTheViewComesBack)
{
  const Machine machine = gentleMachine(100s);
  const Timestamp from{6s}, to{40s};
  const Driven run = runFor(machine, 44s, {}, blindFrom(from, to),
                            wrongFrom(from, to, [](ImuSample& sample) { sample.accel.x() += 0.5; }));

  const StateEstimate &early = run.at(20s), &late = run.at(39s);
  EXPECT_LT((late.map_T_body.translation - early.map_T_body.translation).norm(), 1e-9);
  EXPECT_EQ(late.velocity.norm(), 0);
  const auto deviation = [](const StateEstimate& e) { return std::sqrt(e.covariance(0, 0)); };
  EXPECT_NEAR(deviation(late) - deviation(early), 1.5 * 19, 0.2) << "a machine's speed times the time";
  EXPECT_EQ(late.health, Health::Lost);
  EXPECT_EQ(run.estimates.back().health, Health::Ok);
  EXPECT_LT(run.estimates.back().map_T_body.translation.norm(), 0.05);
  EXPECT_GT(std::sqrt(late.since_start(0, 0)), 1.5 * 19);
  EXPECT_LT(std::sqrt(run.estimates.back().since_start(0, 0)), 0.2) << "the deskewing of the scan that finds it";
}

namespace
{
Machine machineThatDrivesStraight()
{
  Machine machine;
  machine.standstill = 3s;
  machine.drive.x = {0, 1.0, -1.0 / 0.9, 0.9, 0};
  machine.drive.z = {1.5, 0, 0, 1, 0};
  return machine;
}

Eigen::Vector3d deviationSinceStart(const StateEstimate& e) { return e.since_start.diagonal().head<3>().cwiseSqrt(); }
}  // namespace

TEST(LidarInertialSlam, theDoubtOfThePoseSinceTheStartGrowsWithTheWayAndHoldsItsError)
{
  const Machine machine = machineThatDrivesStraight();
  const Driven run = runFor(machine, 33s);
  const StateEstimate &first = run.estimates.front(), &last = run.estimates.back();
  double before = 0;
  for (const Duration t : {5s, 10s, 15s, 20s, 25s, 30s})
  {
    const double now = deviationSinceStart(run.at(t)).x();
    EXPECT_GT(now, before);
    before = now;
  }
  const Rigid measured = first.map_T_body.inverse() * last.map_T_body;
  const Rigid moved = machine.bodyAt(first.stamp).inverse() * machine.bodyAt(last.stamp);
  const Vector6d error = boxMinus(moved, measured);
  const double nees = error.dot(solveSymmetric(last.since_start, error));
  EXPECT_LT(nees, 16.8) << "99 % of chi square with 6 degrees of freedom";
  EXPECT_GT(deviationSinceStart(last).x(), 6e-4 * moved.translation.norm()) << "by which all registrations err alike";
  EXPECT_LT(deviationSinceStart(last).maxCoeff(), 1e-2 * moved.translation.norm());
}

TEST(LidarInertialSlam, isFoundAgainFarFromWhereAWrongImuCarriedIt)
{
  // Blind for four seconds, in which the gyroscope adds 60 degrees of yaw and the accelerometer metres.
  const Machine machine = gentleMachine(3s);
  const Timestamp from{6s}, to{10s};
  const Driven run = runFor(machine, 14s, {}, blindFrom(from, to),
                            wrongFrom(from, to,
                                      [](ImuSample& sample)
                                      {
                                        sample.gyro.z() += 60 * M_PI / 180 / 4;
                                        sample.accel.x() += 0.5;
                                      }));
  EXPECT_EQ(run.at(9900ms).health, Health::Lost);
  EXPECT_EQ(run.recoveries, 1u);
  const Rigid world_T_map = worldTMap(run, machine);
  const auto errorOf = [&](const StateEstimate& e)
  { return ((world_T_map * e.map_T_body).translation - machine.bodyAt(e.stamp).translation).norm(); };
  auto found = std::find_if(run.estimates.begin(), run.estimates.end(), [](auto& e) { return e.recovered; });
  ASSERT_NE(found, run.estimates.end());
  EXPECT_LT(errorOf(*found), 3 * 0.15 * std::sqrt(2)) << "deskewed by the wrong motion";
  EXPECT_GT(std::sqrt(found->covariance(0, 0)), 0.15);
  EXPECT_FALSE(found->keyframe);
  for (++found; found != run.estimates.end(); ++found)
  {
    EXPECT_EQ(found->health, Health::Ok);
    EXPECT_LT(errorOf(*found), 0.06);
  }
}

namespace
{
/** The first IMU falls silent at 8 s; half a second later another one, with biases, takes its place. */
Driven goOnWithAnotherImu(const Machine& machine, bool both_were_heard)
{
  const Rigid body_T_other = Rigid::fromXyzYawPitchRoll(1.5, 0.8, 0.5, -2, 0.1, 0.4);
  const auto other_at = [&](Timestamp t) { return machine.bodyAt(t) * body_T_other; };
  const StandOfStems stand;
  LidarInertialSlam slam(withMachineBox(), kBodyTImu, {});
  Driven run;
  std::vector<ImuSample> first, other;
  Timestamp imu{0ms};
  bool changed = false;
  for (Timestamp start{100ms}; start + 100ms <= Timestamp{16s}; start += 100ms)
  {
    for (; imu <= start + 105ms; imu += 5ms)
    {
      other.push_back(sampleByDifferences(other_at, imu));
      other.back().gyro += Eigen::Vector3d(0.01, -0.01, 0.01);
      other.back().accel += Eigen::Vector3d(0.1, 0.05, -0.1);
      if (changed) slam.addImu(other.back());
      if (imu >= Timestamp{8s}) continue;
      first.push_back(machine.sampleAt(imu));
      slam.addImu(first.back());
    }
    if (!changed && start >= Timestamp{8500ms})
    {
      slam.changeImu({{body_T_other, {}}, other, both_were_heard ? first : std::vector<ImuSample>()});
      changed = true;
    }
    for (StateEstimate& e : slam.addScan(stand.scanAt(start, [&](Timestamp t) { return machine.bodyAt(t); })))
      run.estimates.push_back(std::move(e));
  }
  return run;
}
}  // namespace

TEST(LidarInertialSlam, goesOnWithAnotherImuElsewhereBetterWhereTheFirstOneToldItsBiases)
{
  const Machine machine = gentleMachine(3s);
  for (const auto& [both_were_heard, bound] : {std::pair{true, 0.05}, {false, 0.15}})
  {
    const Driven run = goOnWithAnotherImu(machine, both_were_heard);
    ASSERT_GT(run.estimates.size(), 150U);
    EXPECT_EQ(run.estimates.back().health, Health::Ok);
    EXPECT_LT(largestError(run, machine), bound) << both_were_heard;
  }
}

TEST(LidarInertialSlam, isFoundAgainWhereAWrongImuTiltedIt)
{
  // Gravity then accelerates it, too: blind for four seconds, 7 degrees are 3 m and 2.4 m/s.
  const Machine machine = gentleMachine(3s);
  const Timestamp from{6s}, to{10s};
  for (const int axis : {0, 1})
    for (const double degrees : {-7.0, 7.0})
    {
      const auto tilting = [&](ImuSample& sample) { sample.gyro[axis] += degrees * M_PI / 180 / 4; };
      const Driven run = runFor(machine, 14s, {}, blindFrom(from, to), wrongFrom(from, to, tilting));
      EXPECT_EQ(run.recoveries, 1u) << axis << ' ' << degrees;
      const Rigid world_T_map = worldTMap(run, machine);
      const StateEstimate& end = run.estimates.back();
      EXPECT_EQ(end.health, Health::Ok) << axis << ' ' << degrees;
      const Vector6d off = boxMinus(world_T_map * end.map_T_body, machine.bodyAt(end.stamp));
      EXPECT_LT(off.head<3>().norm(), 0.05) << axis << ' ' << degrees;
      EXPECT_LT(off.tail<3>().norm(), 0.01) << axis << ' ' << degrees;

      const auto found =
          std::find_if(run.estimates.begin(), run.estimates.end(), [](const StateEstimate& e) { return e.recovered; });
      ASSERT_NE(found, run.estimates.end());
      EXPECT_EQ(found->velocity.norm(), 0);  // not that of the IMU that was lost
      const Eigen::Vector3d square_metres = found->covariance.diagonal().head<3>(),
                            of_lidar = found->registration->covariance.diagonal().head<3>();
      const Eigen::Vector3d of_deskewing = Eigen::Vector3d::Constant(0.15 * 0.15);
      EXPECT_LT((square_metres - of_lidar - of_deskewing).norm(), 0.02 * of_lidar.norm());
    }
}

TEST(LidarInertialSlam, anImuThatAddsMetresASecondIsLeftForTheLidar)
{
  const Machine machine = gentleMachine(3s);
  for (const double push : {5.0, 8.0, 15.0, 30.0})  // m/s2, for 0.2 s; the hardest is past the gate in the first scan
  {
    const Driven run = runFor(
        machine, 9s, {}, [](Scan&) {},
        wrongFrom(Timestamp{6s}, Timestamp{6200ms}, [&](ImuSample& sample) { sample.accel.x() += push; }));
    EXPECT_LT(largestError(run, machine), 0.25 + push * 0.2 * 0.3) << push << " m/s2: four scans that are off";
    EXPECT_EQ(run.estimates.back().health, Health::Ok) << push;
  }
}

TEST(LidarInertialSlam, aPlaceThatLeansAgainstGravityIsNotTakenForTheTrueOne)
{
  // From four seconds of blindness on, scans come from a body that leans by 8 degrees; the IMU's does not.
  const Machine machine = gentleMachine(3s);
  const StandOfStems stand;
  const Rigid lean = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, 8 * M_PI / 180);
  const Driven run = runFor(machine, 14s, {},
                            [&](Scan& scan)
                            {
                              if (scan.start >= Timestamp{10s})
                                scan = stand.scanAt(scan.start, [&](Timestamp t) { return machine.bodyAt(t) * lean; });
                              else if (scan.start >= Timestamp{6s})
                                blind(scan);
                            });
  EXPECT_EQ(run.recoveries, 0u);
  EXPECT_GT(run.searches, 20u);
  EXPECT_EQ(run.estimates.back().health, Health::Lost);
  EXPECT_LT(largestError(run, machine), 0.5) << "8 s by the IMU alone";
}

TEST(LidarInertialSlam, addsNoKeyframeWhileItIsNotHealthy)
{
  const Driven run = runFor(gentleMachine(3s), 14s, {}, blindFrom(Timestamp{5s}, Timestamp{9s}));
  for (const StateEstimate& e : run.estimates) EXPECT_TRUE(!e.keyframe || e.health == Health::Ok);
}

namespace
{
/** Another place, which no part of the map shows. */
void liftTo(double height, const Machine& machine, Scan& scan)
{
  static const StandOfStems stand;
  const Rigid lift = Rigid::fromXyzYawPitchRoll(0, 0, height, 0, 0, 0);
  scan = stand.scanAt(scan.start, [&](Timestamp t) { return lift * machine.bodyAt(t); });
}
}  // namespace

TEST(LidarInertialSlam, beginsANewMapWhereTheImuSaysIfTheOldOneIsOutOfSightForGood)
{
  SlamSettings settings;
  settings.slam.trust.restart_after = 3;
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 16s, settings,
                            [&](Scan& scan)
                            {
                              if (scan.start >= Timestamp{5s}) liftTo(30, machine, scan);
                            });
  EXPECT_EQ(run.map_restarts, 1u);
  EXPECT_LT(largestError(run, machine), 0.05) << "5 s by the IMU alone, at up to 2 m/s";
  const StateEstimate& end = run.estimates.back();
  EXPECT_EQ(end.health, Health::Ok);
  const double in_map = std::sqrt(end.covariance(0, 0));
  EXPECT_LT(in_map, 0.02);
  EXPECT_GT(deviationSinceStart(end).x(), in_map) << "where the map began is not known better";
}

TEST(LidarInertialSlam, movesOnIntoANewMapButRestsWhereNothingOfThatIsSeenAgain)
{
  // From 4 s on, scans show places that have nothing in common.
  SlamSettings settings;
  settings.slam.trust.lost_after = settings.slam.trust.restart_after = 1;
  const Machine machine = movingMachine();
  const Driven run = runFor(machine, 10s, settings,
                            [&](Scan& scan)
                            {
                              const auto n = scan.start.time_since_epoch() / 100ms;
                              if (n >= 40) liftTo(7.0 * static_cast<double>(n % 25) - 80, machine, scan);
                            });
  std::vector<double> speeds;
  for (const StateEstimate& e : run.estimates)
    if (e.map_restarted) speeds.push_back(e.velocity.norm());
  ASSERT_EQ(speeds.size(), 2u);
  EXPECT_NEAR(speeds[0], 1.5, 0.2);
  EXPECT_EQ(speeds[1], 0);
}

TEST(LidarInertialSlam, aNewMapIsLevelWhereAWrongImuTiltedTheLostBody)
{
  // Four seconds of the gyroscope tilt it by 7 degrees, by which gravity then accelerates it to 10 m/s.
  const Machine machine = gentleMachine(3s);
  const Timestamp from{6s}, to{10s};
  for (const Timestamp sees_again : {Timestamp{10s}, Timestamp{25s}})
  {
    const Driven run = runFor(
        machine, 32s, {},
        [&](Scan& scan)
        {
          if (scan.start < from) return;
          if (scan.start < sees_again)
            blind(scan);
          else
            liftTo(30, machine, scan);
        },
        wrongFrom(from, to, [](ImuSample& sample) { sample.gyro.x() += 7 * M_PI / 180 / 4; }));
    EXPECT_EQ(run.map_restarts, 1u);
    for (Duration t = 26s; t < 32s; t += 100ms)
    {
      const StateEstimate& e = run.at(t);
      const Eigen::Vector3d up = machine.bodyAt(e.stamp).rotation.conjugate() * Eigen::Vector3d::UnitZ();
      EXPECT_LT((e.map_T_body.rotation * up - Eigen::Vector3d::UnitZ()).norm(), 0.01) << seconds(t) << " s";
      EXPECT_EQ(e.health, Health::Ok) << seconds(t) << " s";
    }
  }
}

TEST(LidarInertialSlam, everyEstimateComesWithACovarianceThatGrowsWhileItIsBlind)
{
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 8s, {}, blindFrom(Timestamp{5s}, Timestamp{6500ms}));
  const auto metres = [&run](Duration t) { return std::sqrt(run.at(t).covariance.topLeftCorner<3, 3>().trace()); };
  for (const StateEstimate& e : run.estimates)
    EXPECT_EQ(e.covariance.llt().info(), Eigen::Success) << nanoseconds(e.stamp);
  EXPECT_LT(metres(5s), 0.02);
  EXPECT_GT(metres(6500ms), 2 * metres(5s));
  EXPECT_LT(metres(8s), 0.02);
}

TEST(LidarInertialSlam, looksForNothingOfTheMapThatItGaveUp)
{
  SlamSettings settings;
  settings.slam.trust.lost_after = 1;
  settings.slam.trust.restart_after = 1.5;
  const StandOfStems stand;
  const Machine machine = gentleMachine(3s);
  const auto rises = [&](Scan& scan)  // out of sight of the map, and again of the one that begins at 7.6 s
  {
    if (scan.start < Timestamp{5s}) return;
    const double height = scan.start < Timestamp{7600ms} ? 30 : 60;
    const auto above = [&](Timestamp t)
    { return Rigid::fromXyzYawPitchRoll(0, 0, height, 0, 0, 0) * machine.bodyAt(t); };
    scan = stand.scanAt(scan.start, above);
  };
  const Driven once = runFor(machine, 7400ms, settings, rises), longer = runFor(machine, 9500ms, settings, rises);
  EXPECT_EQ(once.map_restarts, 0u);
  EXPECT_GE(once.searches, 1u);
  EXPECT_EQ(longer.map_restarts, 1u);
  EXPECT_EQ(longer.estimates.back().health, Health::Lost);
  EXPECT_EQ(longer.searches, once.searches + 2);  // for the scans until the new map begins at 7.6 s
}

TEST(LidarInertialSlam, aScanFromElsewhereIsNotTrusted)
{
  // As if the machine had jumped by a metre for one scan.
  const Machine machine = gentleMachine(3s);
  const StandOfStems stand;
  const Driven run = runFor(machine, 9s, {},
                            [&](Scan& scan)
                            {
                              if (scan.start != Timestamp{8s}) return;
                              const auto jumped = [&](Timestamp t)
                              { return machine.bodyAt(t) * Rigid::fromXyzYawPitchRoll(0, 1, 0, 0, 0, 0); };
                              scan = stand.scanAt(scan.start, jumped);
                            });
  const StateEstimate& jump = run.at(8100ms);
  EXPECT_GT(jump.mahalanobis, 40);
  EXPECT_FALSE(jump.trusted);
  EXPECT_EQ(jump.health, Health::Degenerate);
  EXPECT_EQ(run.estimates.back().health, Health::Ok);
  EXPECT_LT(largestError(run, machine), 0.06);
}

TEST(LidarInertialSlam, followsAlsoWithLidarPosesOfTheMap)
{
  SlamSettings settings;
  settings.slam.relative = false;
  const Machine machine = gentleMachine(3s);
  EXPECT_LT(largestError(runFor(machine, 12s, settings), machine), 0.03);
}

TEST(LidarInertialSlam, theSameInputGivesTheSameBits)
{
  const Driven a = runFor(gentleMachine(3s), 6s), b = runFor(gentleMachine(3s), 6s);
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  for (std::size_t i = 0; i < a.estimates.size(); ++i)
  {
    EXPECT_EQ(a.estimates[i].map_T_body.translation, b.estimates[i].map_T_body.translation);
    EXPECT_EQ(a.estimates[i].map_T_body.rotation.coeffs(), b.estimates[i].map_T_body.rotation.coeffs());
  }
}

/** What was measured last stands first, as where one lidar's turn follows that of another. */
void swapHalves(Scan& scan)
{
  const auto middle = scan.columns.begin() + static_cast<std::ptrdiff_t>(scan.columns.size() / 2);
  PointCloud points;
  for (std::size_t i = middle->first_point; i < scan.points.size(); ++i) points.append(scan.points, i);
  for (std::size_t i = 0; i < middle->first_point; ++i) points.append(scan.points, i);
  scan.points = std::move(points);
  std::rotate(scan.columns.begin(), middle, scan.columns.end());
  std::uint32_t next = 0;
  for (Column& column : scan.columns)
  {
    column.first_point = next;
    next += column.count;
  }
}

TEST(LidarInertialSlam, followsWhereColumnsAreOutOfOrder)
{
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 8s, {}, swapHalves);
  ASSERT_EQ(run.estimates.size(), 79u);
  EXPECT_LT(largestError(run, machine), 0.03);
}

TEST(LidarInertialSlam, columnsOlderThanTheLastEstimateArePlacedOnTheWayToIt)
{
  // The first half of each scan was measured before the end of the one before.
  const auto endLater = [](Scan& scan) { scan.period += 50ms; };
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 8s, {}, endLater);
  EXPECT_LT(largestError(run, machine), 0.03);
}

TEST(LidarInertialSlam, theMapBeginsWithAWholeScanIfThereIsOneWithinASecond)
{
  const auto cutBefore = [](Timestamp end)
  {
    return [end](Scan& scan)
    {
      if (scan.start < end) scan.missing.set(0);
    };
  };
  const Driven soon = runFor(gentleMachine(3s), 4s, {}, cutBefore(Timestamp{300ms}));
  EXPECT_EQ(soon.skipped, 2u);
  EXPECT_EQ(soon.estimates.front().stamp, Timestamp{400ms});

  const Driven never = runFor(gentleMachine(3s), 4s, {}, cutBefore(Timestamp{1h}));
  EXPECT_EQ(never.skipped, 10u);
}

TEST(LidarInertialSlam, aScanThatEndsBeforeAnEarlierOneIsLeftOut)
{
  const auto shorten = [](Scan& scan)
  {
    if (scan.start == Timestamp{2s}) scan.period = 0ms;
  };
  const Driven run = runFor(gentleMachine(3s), 4s, {}, shorten);
  EXPECT_EQ(run.skipped, 1u);
  EXPECT_EQ(run.estimates.size(), 38u);
}

TEST(LidarInertialSlam, withoutImuThereIsNoEstimateAndNoCrash)
{
  LidarInertialSlam slam(SlamSettings{}, kBodyTImu, {});
  const Machine machine = gentleMachine(3s);
  EXPECT_TRUE(
      slam.addScan(StandOfStems().scanAt(Timestamp{100ms}, [&](Timestamp t) { return machine.bodyAt(t); })).empty());
  EXPECT_TRUE(slam.finish().empty());
}

TEST(LidarInertialSlam, threeScansAreTooFewForAStartButGiveThreePoses)
{
  const Driven run = runFor(gentleMachine(0s), 400ms);
  ASSERT_EQ(run.estimates.size(), 3u);
  for (const StateEstimate& e : run.estimates) EXPECT_EQ(e.health, Health::Initialising);
}

TEST(LidarInertialSlam, isNotSearchedWhereItsScansFitButLeaveADirectionOpen)
{
  // Stems and even ground, later the ground alone, where other places fit as well.
  const Machine machine = gentleMachine(3s);
  const Driven run = runFor(machine, 12s, {},
                            [](Scan& scan)
                            {
                              PointCloud& points = scan.points;
                              int ground = 0;
                              for (std::size_t i = 0; i < points.size(); ++i)
                                if (points.z[i] < 0.6f)
                                {
                                  points.x[i] = 0.2f * static_cast<float>(ground % 80) - 8;
                                  points.y[i] = 0.2f * static_cast<float>(ground / 80 % 80) - 8;
                                  points.z[i] = 0;
                                  ++ground;
                                }
                                else if (scan.start >= Timestamp{6s})
                                  points.x[i] = 0, points.y[i] = 0, points.z[i] = 1;  // in the crop box
                            });
  ASSERT_EQ(run.at(11s).registration->outcome, Outcome::Degenerate);
  EXPECT_EQ(run.at(11s).health, Health::Lost);
  EXPECT_EQ(run.searches, 0u);
  EXPECT_LT(largestError(run, machine), 0.5);
}

TEST(LidarInertialSlam, aCorridorIsDegenerateAndTheImuCarriesOn)
{
  // Two walls, even ground and, until 6 s, stems between them: behind those nothing tells how far the body drives.
  const Machine machine = gentleMachine(3s);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-20, 20), up(0, 4);
  const Driven run = runFor(machine, 12s, {},
                            [&](Scan& scan)
                            {
                              PointCloud& points = scan.points;
                              for (std::size_t i = 0; i < points.size(); ++i)
                              {
                                const Rigid map_T_body = machine.bodyAt(scan.start + Duration{points.t[i]});
                                Eigen::Vector3d p = map_T_body * points.position(i).cast<double>();
                                const bool is_stem = p.z() > 0.6;
                                if (is_stem && i % 2) p = {along(random), p.y() > 0 ? 4.0 : -4.0, up(random)};
                                if (!is_stem) p = {along(random), p.y() / 8, 0};
                                if (is_stem && i % 2 == 0 && scan.start >= Timestamp{6s}) p = map_T_body.translation;
                                const Eigen::Vector3d seen = map_T_body.inverse() * p;
                                points.x[i] = static_cast<float>(seen.x());
                                points.y[i] = static_cast<float>(seen.y());
                                points.z[i] = static_cast<float>(seen.z());
                              }
                            });
  ASSERT_EQ(run.at(11s).registration->outcome, Outcome::Degenerate);
  EXPECT_EQ(run.at(11s).health, Health::Degenerate);
  EXPECT_LT(largestError(run, machine), 0.5);
}

TEST(LidarInertialSlam, aLostBodyIsSearchedOnceAScan)
{
  // Put down elsewhere, turned around, with a gyroscope that is wrong: nothing of what is tried fits.
  const Machine machine = gentleMachine(3s);
  const StandOfStems other(7);
  SlamSettings settings;
  settings.slam.trust.contradiction = 0;
  settings.slam.trust.restart_after = 1000;
  const Driven run = runFor(
      machine, 14s, settings,
      [&](Scan& scan)
      {
        if (scan.start >= Timestamp{6s})
          scan = other.scanAt(scan.start, [&](Timestamp t) { return machine.bodyAt(t); });
      },
      wrongFrom(Timestamp{6s}, Timestamp::max(), [](ImuSample& sample) { sample.gyro.z() += 1.5; }));
  const auto lost = std::count_if(run.estimates.begin(), run.estimates.end(),
                                  [](const StateEstimate& e) { return e.health == Health::Lost; });
  EXPECT_EQ(run.estimates.back().health, Health::Lost);
  EXPECT_GT(lost, 30);
  EXPECT_EQ(run.searches, static_cast<std::uint64_t>(lost));  // what one costs: scanloom_bench_slam
}

namespace
{
/** A flat floor, walls 30 m away, and posts. */
RayWorld flatHall()
{
  RayWorld hall{{{Eigen::Vector3d::UnitZ(), 0},
                 {Eigen::Vector3d::UnitX(), -20},
                 {Eigen::Vector3d::UnitX(), 50},
                 {Eigen::Vector3d::UnitY(), -30},
                 {Eigen::Vector3d::UnitY(), 30}},
                {}};
  std::mt19937 random(1);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  while (hall.stems.size() < 40)
  {
    const double x = uniform(-15, 45), y = uniform(-30, 30);
    if (std::abs(y) > 1.5) hall.stems.push_back({{x, y}, uniform(0.1, 0.25)});
  }
  return hall;
}

/** A turn of 16 beams, 0.5 m above the body, each column from where the body is then. */
Scan turnOfSixteenBeams(const RayWorld& world, Timestamp start, const Machine& machine)
{
  constexpr std::size_t kColumns = 900;
  const Rigid body_T_lidar = Rigid::fromXyzYawPitchRoll(0, 0, 0.5, 0, 0, 0);
  return scanOf(kColumns, start,
                [&](Scan& scan, std::size_t column, Timestamp stamp)
                {
                  const Rigid world_T_lidar = machine.bodyAt(stamp) * body_T_lidar;
                  for (int ring = 0; ring < 16; ++ring)
                  {
                    const Eigen::Vector3d ray =
                        rayAt(-2 * M_PI * static_cast<double>(column) / kColumns, (15 - 2 * ring) * kDegree);
                    const auto range = world.range(world_T_lidar.translation, world_T_lidar.rotation * ray, 100);
                    if (!range) continue;
                    append(scan, body_T_lidar * Eigen::Vector3d(*range * ray));
                    scan.points.ring.back() = static_cast<std::uint8_t>(ring);
                  }
                });
}
}  // namespace

TEST(LidarInertialSlam, sixteenBeamsFollowAMachineThroughAFlatHall)
{
  Machine machine = gentleMachine(3s);
  machine.drive.x = {0, 1.5, -1.5 / 0.9, 0.9, 0};  // up to 3 m/s
  machine.drive.yaw = {0, 0, 0, 1, 0};
  machine.drive.pitch = machine.drive.roll = {0, 0, 0, 1, 0};
  const RayWorld hall = flatHall();
  LidarInertialSlam slam({}, kBodyTImu, {{"roof", Rigid::fromXyzYawPitchRoll(0, 0, 0.5, 0, 0, 0)}});
  Driven run;
  Timestamp imu{0ms};
  for (Timestamp start{100ms}; start < Timestamp{20s}; start += 100ms)
  {
    for (; imu <= start + 105ms; imu += 5ms) slam.addImu(machine.sampleAt(imu));
    for (StateEstimate& e : slam.addScan(turnOfSixteenBeams(hall, start, machine))) run.estimates.push_back(e);
  }
  EXPECT_LT(largestError(run, machine), 0.25) << "of 25 m";
  for (const StateEstimate& e : run.estimates) EXPECT_EQ(e.health, Health::Ok);
}

namespace
{
/** Of the stand, in its own frame. */
std::shared_ptr<const PriorMap> mapOf(const StandOfStems& stand, const std::vector<MountedLidar>& lidars,
                                      const Matrix6d& covariance = Matrix6d::Zero())
{
  std::vector<Keyframe> keyframes;
  for (const double x : {0, 4, 8})
  {
    const Rigid world_T_body = Rigid::fromXyzYawPitchRoll(x, 0, 0, 0, 0, 0);
    const Scan scan = stand.scanAt(Timestamp{0s}, [&](Timestamp) { return world_T_body; });
    keyframes.push_back({scan.end(), world_T_body, scan.points});
  }
  return std::make_shared<const PriorMap>(keyframes, lidars, SlamSettings{},
                                          std::vector<Matrix6d>(keyframes.size(), covariance));
}
}  // namespace

TEST(LidarInertialSlam, goesOnInTheMapOfAnEarlierDriveWithItsVelocity)
{
  const Machine machine = gentleMachine(3s);
  const StandOfStems stand;
  const std::vector<MountedLidar> lidars{{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}};
  LidarInertialSlam slam(withMachineBox(), kBodyTImu, lidars);
  Driven run;
  Timestamp imu{0ms};
  for (Timestamp start{100ms}; start < Timestamp{9s}; start += 100ms)
  {
    for (; imu <= start + 105ms; imu += 5ms) slam.addImu(machine.sampleAt(imu));
    for (StateEstimate& e : slam.addScan(stand.scanAt(start, [&](Timestamp t) { return machine.bodyAt(t); })))
      run.estimates.push_back(std::move(e));
    if (start != Timestamp{6s}) continue;
    slam.enterMap(
        {mapOf(stand, lidars, 4e-4 * Matrix6d::Identity()), worldTMap(run, machine), 1e-4 * Matrix6d::Identity()});
  }
  const Timestamp entered = run.estimates.back().stamp - 2s;
  for (const StateEstimate& e : run.estimates)
  {
    if (e.stamp < entered) continue;
    EXPECT_TRUE(e.in_map);
    EXPECT_EQ(e.health, Health::Ok);
    EXPECT_FALSE(e.keyframe) << "the map has some";
    EXPECT_GT(e.since_start(0, 0), 4e-4) << "the map's own error";
    EXPECT_LT((e.map_T_body.translation - machine.bodyAt(e.stamp).translation).norm(), 0.05);
    EXPECT_LT((e.velocity - machine.imuAt(e.stamp).velocity).norm(), 0.1);
  }
}
}  // namespace scanloom::lidar_inertial_slam_unittest
