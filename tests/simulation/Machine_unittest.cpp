#include "simulation/Machine.h"

#include <gtest/gtest.h>

namespace scanloom
{
namespace
{
TEST(Machine, isSeenWhereverItStands)
{
  const Rigid world_T_body = Rigid::fromXyzYawPitchRoll(100, 50, 1, 2, 0.1, 0.1);
  const Ray sideways{world_T_body * Eigen::Vector3d(-1, 5, 1.5), world_T_body.rotation * -Eigen::Vector3d::UnitY()};

  const auto hit = castMachine(world_T_body, sideways);

  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, Surface::Machine);
  EXPECT_NEAR(hit->range, 5 - 1.1, 1e-9);
  EXPECT_NEAR(hit->cosine_incidence, 1, 1e-9);
}
}  // namespace
}  // namespace scanloom
