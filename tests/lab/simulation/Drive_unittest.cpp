#include "lab/simulation/internal/Drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "support/messageOf.h"
#include "support/with.h"

using testing::HasSubstr;

namespace scanloom::drive_unittest
{
namespace
{
Drive windingDrive(const DriveOptions& options = {})
{
  return {Route(options, {}, 1), options, with(&BodyMotionOptions::sway_deg, 3), Ground(GroundOptions{})};
}

/** An hour of short stops along a curve. */
Drive workDay()
{
  DriveOptions options;
  options.route = "work";
  options.duration = 3600;
  options.speed_up = 1;
  return {Route(options, with(&WorkCycleOptions::work_min, 4, with(&WorkCycleOptions::work_max, 12)), 1), options,
          with(&BodyMotionOptions::sway_deg, 3, with(&BodyMotionOptions::sway_rate, 1.5)), Ground(GroundOptions{})};
}

/** Turns round from 27.5 to 37.5 s. */
Drive driveAndReturn()
{
  DriveOptions options;
  options.route = "return";
  options.duration = 65;
  return {Route(options, {}, 1), options, with(&BodyMotionOptions::sway_deg, 3), Ground(GroundOptions{})};
}

/** With low frequencies: differences of the step below are exact enough. */
Drive engineDrive()
{
  EngineOptions engine;
  engine.acceleration = 0.02;
  engine.frequency = 5;
  engine.harmonics = 2;
  engine.highest_frequency = 20;
  engine.turn_rate_deg = 0.2;
  engine.starts_at = 4;
  const DriveOptions options;
  return {
      Route(options, {}, 1), options, {}, Ground({1, 0}, {0.2, 100}), EngineVibration(engine, VibratingPart::Body, 1)};
}

struct DriveCase
{
  const char* name;
  Drive drive;
  double from, to;
};
void PrintTo(const DriveCase& row, std::ostream* out) { *out << row.name; }

class EveryDrive : public testing::TestWithParam<DriveCase>
{
 protected:
  const double step_ = 3e-5;  // s, of the central differences: small against the vibration's period
};

TEST_P(EveryDrive, hasTheVelocityAndAccelerationOfItsPositions)
{
  const Drive& drive = GetParam().drive;
  for (double t = GetParam().from; t < GetParam().to; t += 0.137)
  {
    const Motion before = drive.at(t - step_), now = drive.at(t), after = drive.at(t + step_);
    const Eigen::Vector3d velocity = (after.world_T_body.translation - before.world_T_body.translation) / (2 * step_);
    EXPECT_LT((now.velocity - velocity).norm(), 1e-7) << t;
    EXPECT_LT((now.acceleration - (after.velocity - before.velocity) / (2 * step_)).norm(), 1e-6) << t;
  }
}

TEST_P(EveryDrive, hasTheTurnRatesOfItsRotations)
{
  const Drive& drive = GetParam().drive;
  for (double t = GetParam().from; t < GetParam().to; t += 0.137)
  {
    const Motion before = drive.at(t - step_), now = drive.at(t), after = drive.at(t + step_);
    const Eigen::Vector3d rate =
        logSo3(before.world_T_body.rotation.conjugate() * after.world_T_body.rotation) / (2 * step_);
    EXPECT_LT((now.angular_rate - rate).norm(), 1e-6) << t;
    EXPECT_LT((now.angular_acceleration - (after.angular_rate - before.angular_rate) / (2 * step_)).norm(), 1e-6) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryDrive,
                         testing::Values(DriveCase{"winding", windingDrive(), 2, 21},
                                         DriveCase{"work", workDay(), 2, 60},
                                         DriveCase{"there and back", driveAndReturn(), 2, 63},
                                         DriveCase{"on slopes with an engine", engineDrive(), 2, 21},
                                         DriveCase{"the end of an hour's work", workDay(), 3540, 3600}));

TEST(Drive, comesBackToWhereItStartedWithTheOppositeHeading)
{
  const Drive drive = driveAndReturn();

  const Rigid start = drive.at(0).world_T_body, end = drive.at(65).world_T_body;
  EXPECT_LT((end.translation - start.translation).head<2>().norm(), 1e-9);
  EXPECT_NEAR(std::abs(end.yawPitchRoll().x()), M_PI, 1e-9);
  EXPECT_GT(drive.at(32.5).world_T_body.translation.x(), 15);
}

TEST(Drive, restsBeforeItStartsAndAfterItStopped)
{
  const Drive drive = windingDrive();

  EXPECT_EQ(boxMinus(drive.at(2.5).world_T_body, drive.at(0).world_T_body).norm(), 0);
  EXPECT_LT(boxMinus(drive.at(60).world_T_body, drive.at(57.6).world_T_body).norm(), 1e-12);
  EXPECT_EQ(drive.at(1).velocity.norm(), 0);
  EXPECT_GT(drive.at(10).velocity.norm(), 0.79);
}

TEST(Drive, standsOnFourWheels)
{
  BodyMotionOptions still;
  still.sway_deg = still.vibration = still.vibration_deg = 0;
  const DriveOptions options;
  const Ground ground(GroundOptions{0.4, 0});  // smooth over the length of the machine
  const Drive drive(Route(options, {}, 1), options, still, ground);
  for (double t = 0; t < 22; t += 1.1)
  {
    const Rigid world_T_body = drive.at(t).world_T_body;
    for (const double x : {-1.75, 1.75})
      for (const double y : {-1.0, 1.0})
      {
        const Eigen::Vector3d wheel = world_T_body * Eigen::Vector3d(x, y, 0);
        EXPECT_NEAR(wheel.z(), ground.height(wheel.x(), wheel.y()), 0.01) << t;
      }
  }
}

TEST(Drive, leansWithTheSlope)
{
  BodyMotionOptions still;
  still.sway_deg = still.vibration = still.vibration_deg = 0;
  DriveOptions options;
  options.duration = 200;
  options.speed = 1.5;
  options.curve = 0;
  const Ground ground({0, 0}, {0.2, 200});
  const Drive drive(Route(options, {}, 1), options, still, ground);
  double steepest = 0;
  for (double t = 0; t < 200; t += 3)
  {
    const Rigid world_T_body = drive.at(t).world_T_body;
    const Eigen::Vector3d& p = world_T_body.translation;
    const Eigen::Vector3d up = world_T_body.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_LT((up - ground.normal(p.x(), p.y())).norm(), 2e-3) << t;
    EXPECT_NEAR(p.z(), ground.height(p.x(), p.y()), 0.01) << t;
    steepest = std::max(steepest, std::abs(world_T_body.yawPitchRoll().y()));
  }
  EXPECT_NEAR(steepest, std::atan(0.8 * 0.2), 0.01);
}

TEST(Drive, ofAWindingRouteNeverReturns)
{
  DriveOptions options;
  options.duration = 215;
  options.speed = 1.5;
  options.curve = 6;
  options.curve_length = 110;
  const Drive drive(Route(options, {}, 1), options, {}, Ground(GroundOptions{}));
  double before = -1;
  for (double t = 3; t < 212; t += 1)
  {
    const double x = drive.at(t).world_T_body.translation.x();
    EXPECT_GT(x, before);
    before = x;
  }
  EXPECT_GT(before, 300);
  EXPECT_LT(drive.path().size(), 1500U);
}

TEST(Drive, ofMoreForestThanFitsIntoAMachineIsRefused)
{
  DriveOptions options;
  options.duration = 1e5;
  const Drive drive(Route(options, {}, 1), options, {}, Ground(GroundOptions{}));
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { drive.path(); }), HasSubstr("82 km"));
}

TEST(Drive, hasAPathThatIsNeverFarFromTheMachineHoweverLongItWorks)
{
  const Drive drive = workDay();
  const std::vector<Eigen::Vector2d> path = drive.path();
  EXPECT_LT(path.size(), 400u);  // 40 m, and what is behind it
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_LE((path[i] - path[i - 1]).norm(), 0.25);
  for (double t = 0; t < 3600; t += 7)
  {
    const Eigen::Vector2d at = drive.at(t).world_T_body.translation.head<2>();
    double nearest = 1e9;
    for (const Eigen::Vector2d& p : path) nearest = std::min(nearest, (p - at).norm());
    EXPECT_LT(nearest, 0.13) << t;
  }
}
}  // namespace
}  // namespace scanloom::drive_unittest
