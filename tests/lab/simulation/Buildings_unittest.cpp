#include "lab/simulation/internal/Buildings.h"

#include "lab/simulation/RecordingOptions.h"
#include "lab/simulation/checkedScene.h"
#include "lab/simulation/internal/Boxes.h"
#include "lab/simulation/internal/Random.h"

#include "base/core/ConfigError.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::buildings_unittest
{
namespace
{
SimulationSettings settingsOf(const std::string& kind)
{
  SimulationSettings settings;
  settings.drive.duration = 20;
  settings.machine.kind = "robot";
  settings.forest.stand.stems_per_hectare = settings.forest.stand.stumps_per_hectare = 0;
  settings.forest.foliage.undergrowth_cover = 0;
  settings.ground = {0, 0};
  settings.buildings.kind = kind;
  if (kind == "stairs") settings.slopes = {0.4, 30}, settings.drive.curve = 0;
  return settings;
}

Eigen::Vector3d randomDirection(Random& random)
{
  const double z = random.uniform(-1, 1), around = random.uniform(0, 2 * M_PI), r = std::sqrt(1 - z * z);
  return {r * std::cos(around), r * std::sin(around), z};
}

std::optional<Contact> nearestOf(const std::vector<OrientedBox>& boxes, const Ray& ray, double max_range)
{
  std::optional<Contact> nearest;
  for (const OrientedBox& box : boxes)
    if (const auto contact = box.cast(ray); contact && contact->range < (nearest ? nearest->range : max_range))
      nearest = contact;
  return nearest;
}

class EachKind : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(, EachKind, testing::Values("street", "hall", "car_park", "hedge", "corridor", "stairs"));
}  // namespace

TEST_P(EachKind, raysMeetTheNearestOfAllBoxes)
{
  const Scene scene = checkedScene(settingsOf(GetParam()), 3);
  const std::vector<OrientedBox> boxes = build(settingsOf(GetParam()).buildings, scene.scenery.drive(), 3);
  ASSERT_GT(boxes.size(), 10U);
  const Boxes found_by_tree(boxes);
  Random random(1, RandomStream::Lidar, 0);
  int hits = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const Eigen::Vector3d from =
        scene.scenery.drive().at(random.uniform(0, 20)).world_T_body * Eigen::Vector3d(0, 0, 2);
    const Ray ray{from, randomDirection(random)};
    const auto expected = nearestOf(boxes, ray, 80), actual = found_by_tree.cast(ray, 80);
    ASSERT_EQ(expected.has_value(), actual.has_value()) << i;
    if (!expected) continue;
    ++hits;
    EXPECT_EQ(expected->range, actual->range) << i;
    EXPECT_EQ(expected->cosine_incidence, actual->cosine_incidence) << i;
  }
  EXPECT_GT(hits, 40);
}

TEST_P(EachKind, theMachineDrivesFreely)
{
  const Scene scene = checkedScene(settingsOf(GetParam()), 4);
  const Boxes boxes(build(settingsOf(GetParam()).buildings, scene.scenery.drive(), 4));
  for (double t = 0; t < 20; t += 0.25)
    for (const double side : {-1.0, 1.0})
    {
      const Rigid world_T_body = scene.scenery.drive().at(t).world_T_body;
      const Ray ray{world_T_body * Eigen::Vector3d(0, 0, 1), world_T_body.rotation * Eigen::Vector3d(0, side, 0)};
      EXPECT_FALSE(boxes.cast(ray, 1)) << "at " << t << " s";
    }
}

TEST(Buildings, anUnknownKindIsRefusedByName)
{
  try
  {
    checkedScene(settingsOf("castle"), 1);
    FAIL();
  }
  catch (const UsageError& error)
  {
    EXPECT_NE(std::string(error.what()).find("[simulated_buildings] kind = 'castle'"), std::string::npos);
  }
}

TEST(Boxes, withoutBoxesNothingIsMet)
{
  EXPECT_FALSE(Boxes({}).cast({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, 100));
}

TEST(MovingObjects, oneCarKeepsAheadAndOthersComeTowardsTheMachine)
{
  SimulationSettings settings = settingsOf("street");
  settings.objects = {0, 0, 1.7, 9, false, 5};
  const Scene scene = checkedScene(settings, 5);
  const auto aheadAt = [&](double t)
  {
    double least = 1e9;
    for (const MovingObject& car : scene.scenery.objects().at(t))
      if (car.velocity.norm() < 5)
        least = std::min(least, car.ground_point.x() - scene.scenery.drive().at(t).world_T_body.translation.x());
    return least;
  };
  EXPECT_NEAR(aheadAt(8), 20, 4.1);
  EXPECT_NEAR(aheadAt(14), 20, 4.1);
  const auto cars = scene.scenery.objects().at(10);
  EXPECT_TRUE(std::any_of(cars.begin(), cars.end(), [](const MovingObject& car) { return car.velocity.x() < -9; }));
}
}  // namespace scanloom::buildings_unittest
