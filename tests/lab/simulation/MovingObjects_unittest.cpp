#include "lab/simulation/internal/MovingObjects.h"

#include <gtest/gtest.h>

#include <map>

#include "mantle.h"
#include "support/with.h"

namespace scanloom::moving_objects_unittest
{
namespace
{
Drive workDay()
{
  DriveOptions options;
  options.route = "work";
  options.duration = 900;
  options.speed_up = 1;
  return {Route(options, with(&WorkCycleOptions::work_max, 60), 1), options, {}, Ground(GroundOptions{})};
}

TEST(MovingObjects, passTheMachineAtTheSpeedAndTheDistanceThatWereGiven)
{
  const Drive drive = workDay();
  const ObjectOptions options;
  const MovingObjects objects(options, drive, 1);
  std::map<std::uint64_t, double> nearest;
  std::map<ObjectKind, int> seen;
  for (double t = 0; t < 900; t += 0.1)
    for (const MovingObject& object : objects.at(t))
    {
      ++seen[object.kind];
      if (object.kind == ObjectKind::Tree) continue;
      EXPECT_NEAR(object.velocity.norm(), 2.78, 1e-12);
      EXPECT_EQ(object.ground_point.z(), drive.ground().height(object.ground_point.x(), object.ground_point.y()));
      const double distance = (object.ground_point - drive.at(t).world_T_body.translation).head<2>().norm();
      nearest[object.id] = std::min(nearest.try_emplace(object.id, 1e9).first->second, distance);
    }
  EXPECT_GE(nearest.size(), 18u);  // 15 persons, 7 vehicles in 15 minutes, as far as they are over
  for (const auto& [id, distance] : nearest) EXPECT_GT(distance, 0.6 * 9 - 3.1) << id;  // it may drive on meanwhile
  EXPECT_GT(seen[ObjectKind::Person], 15 * 150);
  EXPECT_GT(seen[ObjectKind::Vehicle], 5 * 150);
  EXPECT_GT(seen[ObjectKind::Tree], 1000);
}

TEST(MovingObjects, moveAsTheirVelocitySays)
{
  const Drive drive = workDay();
  const MovingObjects objects({}, drive, 1);
  int compared = 0;
  for (double t = 0; t < 600; t += 1.7)
    for (const MovingObject& before : objects.at(t))
      for (const MovingObject& after : objects.at(t + 0.1))
        if (before.id == after.id)
        {
          EXPECT_LT(((after.ground_point - before.ground_point).head<2>() - 0.1 * before.velocity).norm(), 1e-9);
          ++compared;
        }
  EXPECT_GT(compared, 300);
}

TEST(MovingObjects, atEveryStopATreeFallsFromUprightToLyingAndOnlyThenIsSaidToMove)
{
  const Drive drive = workDay();
  const MovingObjects objects({}, drive, 1);
  std::map<std::uint64_t, double> tilt;
  for (double t = 0; t < 900; t += 0.05)
    for (const MovingObject& object : objects.at(t))
    {
      if (object.kind != ObjectKind::Tree) continue;
      const double before = tilt.try_emplace(object.id, object.tilt).first->second;
      EXPECT_GE(object.tilt, before) << "it does not rise again";
      EXPECT_TRUE(object.moves || object.tilt == 0 || object.tilt == M_PI / 2) << object.tilt;
      tilt[object.id] = object.tilt;
    }
  int lying = 0;
  for (const auto& [id, angle] : tilt) lying += angle == M_PI / 2;
  EXPECT_GT(lying, 8);
  EXPECT_GE(lying + 2, static_cast<int>(tilt.size()));
}

TEST(MovingObjects, areNoneWhereNoneAreWanted)
{
  ObjectOptions none;
  none.person_every = none.vehicle_every = 0;
  none.felled_trees = false;
  const Drive drive = workDay();
  const MovingObjects objects(none, drive, 1);
  for (double t = 0; t < 900; t += 10) EXPECT_TRUE(objects.at(t).empty());
}

TEST(MovingObjects, standWhereTheyAreSaidToBe)
{
  MovingObject person;
  person.ground_point << 3, 4, 0.5;
  person.size << 0.5, 0.5, 1.75;
  MovingObject tree = person;
  tree.kind = ObjectKind::Tree;
  tree.size << 0.24, 0.24, 16;
  tree.taper = 0.2;
  tree.tilt = M_PI / 2;
  tree.yaw = M_PI / 2;
  const auto cones = conesOf({person, tree});
  ASSERT_EQ(cones.size(), 2u);
  EXPECT_NEAR(castCone(cones[0], {{-7, 4, 1.5}, Eigen::Vector3d::UnitX()})->range, 9.75, 1e-12);
  EXPECT_NEAR(distanceToMantle(cones[1], {3, 4, 0.5}), -0.12, 1e-3) << "at its foot";
  const auto lying = castCone(cones[1], {{3, 10, 5}, -Eigen::Vector3d::UnitZ()});
  ASSERT_TRUE(lying) << "it fell along y";
  EXPECT_NEAR(lying->range, 4.5 - 0.12 * (1 - 0.8 * 6 / 16), 1e-3);

  MovingObject vehicle = person;
  vehicle.kind = ObjectKind::Vehicle;
  vehicle.size << 4, 2, 1.7;
  const auto boxes = boxesOf({vehicle, tree});
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_NEAR(boxes[0].cast({{-7, 4, 1.5}, Eigen::Vector3d::UnitX()})->range, 8, 1e-12);
  EXPECT_FALSE(boxes[0].cast({{-7, 4, 2.3}, Eigen::Vector3d::UnitX()})) << "above its roof";
}
}  // namespace
}  // namespace scanloom::moving_objects_unittest
