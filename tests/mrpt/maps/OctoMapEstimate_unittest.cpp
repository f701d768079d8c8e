#include "mrpt/maps/OctoMapEstimate.h"

#include <gtest/gtest.h>

namespace scanloom::octo_map_estimate_unittest
{
namespace
{
const DriveSize kFourKeyframesOfTwoOs0{{131072, 131072}, 4, 12};

/** Nodes that tests/benchmarks/output_benchmark.cpp counts in its sparse stand, at 56 bytes. */
TEST(OctoMapEstimate, isAnUpperBoundWithinAFactorOfThreeOfMeasuredTrees)
{
  const std::pair<const char*, double> measured[] = {{"preview", 6.47e6}, {"inventory", 20.8e6}, {"fine", 70.9e6}};
  for (const auto& [preset, nodes] : measured)
  {
    const OctoMapCost cost = estimateOf(octoMapPreset(preset), kFourKeyframesOfTwoOs0);
    EXPECT_GT(cost.bytes, 56 * nodes) << preset;
    EXPECT_LT(cost.bytes, 3 * 56 * nodes) << preset;
  }
}

TEST(OctoMapEstimate, aDriveOnTheSpotCostsTimeButNoMoreMemory)
{
  DriveSize longer = kFourKeyframesOfTwoOs0;
  longer.keyframes = 40;
  const OctoMapCost once = estimateOf({0.1, 20}, kFourKeyframesOfTwoOs0), again = estimateOf({0.1, 20}, longer);
  EXPECT_DOUBLE_EQ(again.bytes, once.bytes);
  EXPECT_DOUBLE_EQ(again.seconds, 10 * once.seconds);
}

TEST(OctoMapEstimate, fewRaysMeetFewVoxels)
{
  const OctoMapCost sparse = estimateOf({0.05, 15}, {{100}, 1, 0});
  EXPECT_LT(sparse.bytes, 100 * 300 * 8.0 / 7 * 56 + 1);
}
}  // namespace
}  // namespace scanloom::octo_map_estimate_unittest
