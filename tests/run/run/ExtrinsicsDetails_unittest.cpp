#include "run/run/internal/ExtrinsicsDetails.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::extrinsics_details_unittest
{
namespace
{
/** Rises by 10 % along x; points every 0.2 m. */
Points3 ground()
{
  Points3 points;
  for (float x = -12; x < 12; x += 0.2F)
    for (float y = -12; y < 12; y += 0.2F) points.emplace_back(x, y, 0.1F * x);
  return points;
}

/** A stem of 20 cm at (5, 3). */
Points3 groundAndStem()
{
  Points3 points = ground();
  for (float z = 0.5F; z < 3; z += 0.05F)
    for (float a = 0; a < 6; a += 0.5F) points.emplace_back(5 + 0.1F * std::cos(a), 3 + 0.1F * std::sin(a), z);
  return points;
}
}  // namespace

TEST(ExtrinsicsDetails, findTheStem)
{
  const std::optional<SeenStem> stem = bestStem(groundAndStem(), groundAndStem());
  ASSERT_TRUE(stem);
  EXPECT_LT((stem->centre - Eigen::Vector2f(5, 3)).norm(), 0.3);
}

TEST(ExtrinsicsDetails, findNoStemThatOnlyOneLidarSees) { EXPECT_FALSE(bestStem(groundAndStem(), {})); }

TEST(ExtrinsicsDetails, measureHeightsAboveSlopingGround)
{
  const std::optional<GroundStrip> strip = bestGroundStrip(ground(), ground());
  ASSERT_TRUE(strip);
  Eigen::Vector3f above;
  above[strip->axis] = strip->from + kStripLength / 2;
  above[1 - strip->axis] = strip->across;
  above.z() = 0.1F * above.x() + 0.05F;
  EXPECT_NEAR(strip->height(above), 0.05, 0.02);
}
}  // namespace scanloom::extrinsics_details_unittest
