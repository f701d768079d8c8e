#include "lab/simulation/internal/Cone.h"
#include "lab/simulation/internal/Random.h"

#include <gtest/gtest.h>

#include "mantle.h"

namespace scanloom::cone_unittest
{
namespace
{
const Cone kUpright{{5, 0, -1}, Eigen::Vector3d::UnitZ(), 10, 0.3, 0.1};

TEST(Cone, isMetOnItsMantleFacingTheRay)
{
  const auto entry = kUpright.intersect({{0, 0, 4}, Eigen::Vector3d::UnitX()});

  ASSERT_TRUE(entry);
  EXPECT_NEAR(entry->range, 4.8, 1e-12) << "half way up the radius is 0.2 m";
  EXPECT_NEAR(entry->normal.z() / -entry->normal.x(), 0.2 / 10, 1e-12) << "the mantle narrows 0.2 m over 10 m";
}

TEST(Cone, isNotMetBesideBehindAndAbove)
{
  EXPECT_FALSE(kUpright.intersect({{0, 0.21, 4}, Eigen::Vector3d::UnitX()})) << "beside";
  EXPECT_FALSE(kUpright.intersect({{0, 0, 4}, -Eigen::Vector3d::UnitX()})) << "behind";
  EXPECT_FALSE(kUpright.intersect({{0, 0, 9.1}, Eigen::Vector3d::UnitX()})) << "above the top";
  EXPECT_FALSE(kUpright.intersect({{5, 0, 4}, Eigen::Vector3d::UnitX()})) << "from inside";
}

TEST(Cone, isCutOffSquarely)
{
  const auto from_above = kUpright.intersect({{5.05, 0, 20}, -Eigen::Vector3d::UnitZ()});
  ASSERT_TRUE(from_above);
  EXPECT_NEAR(from_above->range, 11, 1e-12);
  EXPECT_EQ(from_above->normal, Eigen::Vector3d::UnitZ());
}

/** Rays all around a leaning cone, against steps of 0.1 mm along each. */
TEST(Cone, isEnteredWhereTheFirstPointLiesInside)
{
  const Cone cone{{0.2, 0.1, 0}, Eigen::Vector3d(0.3, -0.2, 1).normalized(), 1.5, 0.2, 0.05};
  const auto isInside = [&](const Eigen::Vector3d& p)
  {
    const double along = (p - cone.base).dot(cone.axis);
    return along >= 0 && along <= cone.length && distanceToMantle(cone, p) < 0;
  };
  Random random(1, RandomStream::Stand, 0);
  int met = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d target(random.uniform(-0.2, 1), random.uniform(-0.5, 0.5), random.uniform(-0.2, 1.7));
    Ray ray{3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized(), {}};
    ray.direction = (target - ray.origin).normalized();
    double range = 0;
    while (range < 6 && !isInside(ray.at(range))) range += 1e-4;

    const auto entry = cone.intersect(ray);
    met += range < 6;
    ASSERT_TRUE(entry || range >= 6) << i;
    if (!entry || range >= 6) continue;  // a grazing ray may pass between two steps
    EXPECT_NEAR(entry->range, range, 1.1e-4) << i;
    EXPECT_LT(entry->normal.dot(ray.direction), 0) << i;
    EXPECT_NEAR(entry->normal.norm(), 1, 1e-12) << i;
  }
  EXPECT_GT(met, 30);
}
}  // namespace
}  // namespace scanloom::cone_unittest
