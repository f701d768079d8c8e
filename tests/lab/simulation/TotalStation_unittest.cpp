#include "lab/simulation/internal/TotalStation.h"

#include "lab/simulation/internal/Scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scanloom::total_station_unittest
{
namespace
{
/** A machine at rest in the open, 12 m in front of the station. */
SimulationSettings atRest()
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.speed_up = 1;
  settings.drive.standstill = 1000;
  settings.drive.duration = 200;
  settings.objects.person_every = settings.objects.vehicle_every = 0;
  settings.objects.felled_trees = false;
  settings.machine.body.clear();
  settings.machine.has_boom = false;
  settings.forest.stand.stems_per_hectare = settings.forest.stand.stumps_per_hectare = 0;
  settings.forest.foliage.undergrowth_cover = 0;
  return settings;
}

std::vector<PrismMeasurement> measured(const Scene& scene)
{
  std::vector<PrismMeasurement> all;
  for (std::uint64_t n = 0; scene.station.secondsOf(n) < scene.span.duration; ++n)
    if (const auto prism = scene.station.measure(scene.scenery, n)) all.push_back(*prism);
  return all;
}

Eigen::Vector3d trueStationPrism(const Scene& scene, double t)
{
  return stationTWorld() * (scene.scenery.drive().at(t).world_T_body * scene.body_T_prism.translation);
}
}  // namespace

TEST(TotalStation, scattersAboutThePrismByItsNoise)
{
  SimulationSettings settings = atRest();
  settings.station.noise = 0.003;
  settings.station.angle_noise = 0;
  const Scene scene = makeScene(settings, 1);

  const auto all = measured(scene);

  ASSERT_NEAR(static_cast<double>(all.size()), 7 * 200, 1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (const PrismMeasurement& prism : all)
  {
    const Eigen::Vector3d error = prism.station_p - trueStationPrism(scene, 0);
    sum += error;
    squares += error.cwiseProduct(error);
  }
  const double count = static_cast<double>(all.size());
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(sum[i] / count, 0, 4 * 0.003 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares[i] / count), 0.003, 0.0003);
  }
}

TEST(TotalStation, errsInAngleAcrossTheLineOfSightInProportionToTheDistance)
{
  SimulationSettings settings = atRest();
  settings.station.noise = 0;
  settings.station.angle_noise = 600;  // arc seconds
  for (const double distance : {12.0, 48.0})
  {
    settings.station.x = -distance;
    const Scene scene = makeScene(settings, 1);
    const Eigen::Vector3d eye(-distance, 0, scene.scenery.world().ground().height(-distance, 0.0) + 1.7);
    const Eigen::Vector3d prism = stationTWorld().inverse() * trueStationPrism(scene, 0);
    const Eigen::Vector3d sight = prism - eye;
    double across = 0, count = 0;
    for (const PrismMeasurement& seen : measured(scene))
    {
      const Eigen::Vector3d error = stationTWorld().inverse() * seen.station_p - prism;
      EXPECT_NEAR(error.dot(sight.normalized()), 0, 1e-9);
      across += error.squaredNorm();
      ++count;
    }
    const double per_axis = std::sqrt(across / count / 2);
    EXPECT_NEAR(per_axis / sight.norm(), 600 * M_PI / 180 / 3600, 0.1 * 600 * M_PI / 180 / 3600) << distance;
  }
}

TEST(TotalStation, stampsByItsOwnClock)
{
  SimulationSettings settings = atRest();
  const auto right = measured(makeScene(settings, 1));
  settings.station.stamp_offset = 0.25;
  const auto late = measured(makeScene(settings, 1));

  ASSERT_EQ(late.size(), right.size());
  for (std::size_t i = 0; i < late.size(); ++i)
  {
    EXPECT_EQ(late[i].stamp - right[i].stamp, 250ms);
    EXPECT_EQ(late[i].station_p, right[i].station_p);
  }
}

TEST(TotalStation, losesTheShareThatItIsTold)
{
  SimulationSettings settings = atRest();
  settings.station.lost = 0.3;
  EXPECT_NEAR(static_cast<double>(measured(makeScene(settings, 1)).size()), 0.7 * 1400, 60);
}

TEST(TotalStation, seesNoPrismBehindTheMachine)
{
  SimulationSettings settings = atRest();
  settings.drive.duration = 5;
  settings.body_T_prism.translation.y() = 0;
  ASSERT_EQ(measured(makeScene(settings, 1)).size(), 35U);
  settings.machine.body = {{Eigen::Vector3d(-3, -2, 0.5), Eigen::Vector3d(-2, 2, 6)}};  // between them
  EXPECT_EQ(measured(makeScene(settings, 1)).size(), 0U);
  settings.station.occlusion = false;
  EXPECT_EQ(measured(makeScene(settings, 1)).size(), 35U);
}

TEST(TotalStation, losesThePrismWhileAVehiclePasses)
{
  SimulationSettings settings = atRest();
  settings.drive.duration = 60;
  settings.objects.vehicle_every = 20;
  settings.objects.vehicle_height = 10;
  settings.objects.pass_distance = 5;
  const Scene scene = makeScene(settings, 1);
  const std::size_t seen = measured(scene).size();
  const Eigen::Vector3d eye(-12, 0, scene.scenery.world().ground().height(-12.0, 0.0) + 1.7);
  const Eigen::Vector3d prism = stationTWorld().inverse() * trueStationPrism(scene, 0);
  const double far = (prism - eye).norm() - 0.1;

  std::size_t free = 0;  // by the vehicles' boxes alone
  std::uint64_t all = 0;
  for (; scene.station.secondsOf(all) < scene.span.duration; ++all)
  {
    bool hidden = false;
    for (const OrientedBox& box : boxesOf(scene.scenery.objects().at(scene.station.secondsOf(all))))
      if (const auto contact = box.cast({eye, (prism - eye).normalized()}); contact && contact->range < far)
        hidden = true;
    if (!hidden) ++free;
  }
  EXPECT_LT(free, all) << "a scene in which none hides the prism tests nothing";
  EXPECT_EQ(seen, free);
}
}  // namespace scanloom::total_station_unittest
