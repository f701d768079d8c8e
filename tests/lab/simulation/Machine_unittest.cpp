#include "lab/simulation/internal/Machine.h"

#include "base/config/Configuration.h"
#include "lab/simulation/internal/Scene.h"

#include <gtest/gtest.h>

namespace scanloom::machine_unittest
{
namespace
{
/** Stops of 40 s, so that the boom makes five moves at each. */
SimulationSettings working()
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.duration = 300;
  settings.drive.speed_up = 1;
  settings.work.work_min = settings.work.work_max = 40;
  settings.forest.stand.stems_per_hectare = 0;
  return settings;
}

Boom workingBoom()
{
  const SimulationSettings settings = working();
  return {Route(settings.drive, settings.work, 1), 1};
}

TEST(Machine, isSeenWhereverItStands)
{
  const SimulationSettings settings = working();
  const Scene scene = makeScene(settings, 1);
  const Machine& machine = scene.scenery.machine();
  const Rigid world_T_body = Rigid::fromXyzYawPitchRoll(100, 50, 1, 2, 0.1, 0.1);
  const Moment moment(scene.scenery.world(), machine, world_T_body, machine.boom().at(0), {}, 0);
  const Ray sideways{world_T_body * Eigen::Vector3d(-2, 5, 1.5), world_T_body.rotation * -Eigen::Vector3d::UnitY()};

  const auto hit = moment.cast({sideways, 50, 0});

  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, Surface::Machine);
  EXPECT_NEAR(hit->range, 5 - 1.25, 1e-9);
  EXPECT_NEAR(hit->cosine_incidence, 1, 1e-9);
  EXPECT_FALSE(moment.cast({sideways, 3, 0})) << "beyond the range that was asked for";
}

TEST(Machine, hidesAboutAThirdOfEachLidarsDirections)
{
  const Scene scene = makeScene(working(), 1);
  for (const LidarStation& station : scene.lidars)
  {
    double hidden = 0, rays = 0;
    const double t = 20;  // at work
    const Moment moment = scene.scenery.at(t);
    const Rigid world_T_sensor = moment.worldTBody() * station.written_body_T_sensor;
    for (int i = 0; i < 512; ++i)
      for (int j = 0; j < 32; ++j)
      {
        const double azimuth = 2 * M_PI * i / 512, altitude = (j - 15.5) / 32 * M_PI / 2;
        const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                                        std::sin(altitude));
        const auto hit = moment.cast({{world_T_sensor.translation, world_T_sensor.rotation * direction}, 50, 0});
        hidden += hit && (hit->surface == Surface::Machine || hit->surface == Surface::Boom);
        ++rays;
      }
    EXPECT_GT(hidden / rays, 0.28) << station.name;
    EXPECT_LT(hidden / rays, 0.38) << station.name;
  }
}

TEST(Boom, keepsTheLengthOfItsLinks)
{
  const Boom boom = workingBoom();
  for (double t = 0; t < 300; t += 0.5)
  {
    const BoomJoints joints = boom.jointsAt(boom.at(t));
    EXPECT_NEAR(joints.elbow.norm(), 4.0, 1e-12);
    EXPECT_NEAR((joints.tip - joints.elbow).norm(), 4.5, 1e-12);
    EXPECT_GT(joints.elbow.y(), joints.tip.y() * joints.elbow.x() / joints.tip.x()) << "elbow upwards";
  }
}

TEST(Boom, slewsAtTheRatesThatWereGivenWhileItWorksAndRestsWhileItDrives)
{
  const Boom boom = workingBoom();
  const SimulationSettings settings = working();
  const Route route(settings.drive, settings.work, 1);
  const double step = 1e-3;
  double fastest = 0;
  int moving = 0, working_time = 0;
  for (double t = 0; t < 299; t += 0.02)
  {
    const double rate = std::abs(boom.at(t + step).slew - boom.at(t).slew) / step * 180 / M_PI;
    fastest = std::max(fastest, rate);
    if (route.workStopAt(t))
    {
      ++working_time;
      moving += rate > 0.1;
    }
    else if (route.driving(t).value > 0)
    {
      EXPECT_EQ(boom.at(t).slew, 0) << t;
      EXPECT_EQ(boom.at(t).reach, 4.5) << t;
    }
  }
  EXPECT_GT(fastest, 20);
  EXPECT_LE(fastest, 40.001);
  EXPECT_GT(moving, working_time / 5);
}

TEST(Boom, doesNotJump)
{
  const Boom boom = workingBoom();
  for (double t = 0; t < 299; t += 0.01)
  {
    EXPECT_LT(std::abs(boom.at(t + 0.01).slew - boom.at(t).slew), 0.41 * M_PI / 180) << t;
    EXPECT_LT(std::abs(boom.at(t + 0.01).reach - boom.at(t).reach), 0.1) << t;
  }
}
}  // namespace
}  // namespace scanloom::machine_unittest
