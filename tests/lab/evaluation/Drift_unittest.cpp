#include "lab/evaluation/Drift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::drift_unittest
{
namespace
{
const Rigid kElsewhere = Rigid::fromXyzYawPitchRoll(500, -80, 40, 2.4, 0, 0);

/** Along x in steps of `step`, one a second; the estimate in a frame of its own. */
std::vector<PositionPair> straight(int samples, double step, const Rigid& map_T_reference = kElsewhere)
{
  std::vector<PositionPair> pairs;
  for (int i = 0; i < samples; ++i)
  {
    const Eigen::Vector3d reference_p(i * step, 0, 0);
    pairs.push_back({Timestamp{i * 1s}, map_T_reference * reference_p, reference_p});
  }
  return pairs;
}

TEST(Drift, isZeroForTheSamePathInAnotherFrame)
{
  EXPECT_LT(driftOf(straight(11, 1), AlignmentKind::Yaw).largest, 1e-12);
  EXPECT_LT(driftOf(straight(11, 1), AlignmentKind::Se3).largest, 1e-12);
}

TEST(Drift, isTheLargestDistanceAnywhereOnceTheStartAgrees)
{
  std::vector<PositionPair> pairs = straight(11, 1);
  pairs[7].map_p.z() += 0.3;
  pairs[10].map_p.z() -= 0.1;

  const Drift drift = driftOf(pairs, AlignmentKind::Yaw);

  EXPECT_NEAR(drift.largest, 0.3, 1e-12);
  EXPECT_EQ(drift.largest_at, Timestamp{7s});
  EXPECT_NEAR(drift.final, 0.1, 1e-12);
  EXPECT_EQ(drift.samples, 11U);
  EXPECT_EQ(drift.path_length, 10);
  EXPECT_NEAR(*drift.percent(), 3, 1e-10);
}

TEST(Drift, restsOnAllSamplesUpToATenthOfThePath)
{
  // At 0 and at 1 m of 10 m. Their mean moves by half of what the second one is off, all others by the other half.
  std::vector<PositionPair> pairs = straight(11, 1);
  pairs[1].map_p.z() += 0.2;

  const Drift drift = driftOf(pairs, AlignmentKind::Yaw);

  EXPECT_EQ(drift.fitted, 2U);
  EXPECT_NEAR(drift.largest, 0.1, 1e-12);
}

TEST(Drift, measuresThePathInStepsOfAtLeastHalfAMetre)
{
  EXPECT_NEAR(driftOf(straight(12, 0.3), AlignmentKind::Yaw).path_length, 3, 1e-12);  // 5 times 0.6 of 3.3 m

  std::vector<PositionPair> standing = straight(100, 0);
  for (std::size_t i = 0; i < standing.size(); ++i) standing[i].reference_p.y() = i % 2 == 0 ? 0.24 : -0.24;
  EXPECT_EQ(driftOf(standing, AlignmentKind::Yaw).path_length, 0);
  EXPECT_EQ(driftOf(standing, AlignmentKind::Yaw).percent(), std::nullopt);
}

TEST(Drift, ofAPitchedFrameGrowsWithTheDistanceForYawOnly)
{
  // The frames agree at 0.5 m, the mean of the samples that are fitted; the last one is 9.5 m further.
  const std::vector<PositionPair> pairs = straight(11, 1, Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0.01, 0));

  EXPECT_NEAR(driftOf(pairs, AlignmentKind::Yaw).largest, 9.5 * 2 * std::sin(0.005), 1e-12);
  EXPECT_LT(driftOf(pairs, AlignmentKind::Se3).largest, 1e-12);
}

TEST(Drift, isToldAlongTheReference)
{
  std::vector<PositionPair> pairs = straight(21, 0.25);
  pairs[13].map_p.z() += 0.4;  // 3.25 m: after the vertex at 3 m
  pairs[14].map_p.z() += 0.2;  // 3.5 m

  const std::vector<ErrorAtDistance> over_distance = driftOf(pairs, AlignmentKind::Yaw).over_distance;

  ASSERT_EQ(over_distance.size(), 11U);
  EXPECT_NEAR(over_distance[6].distance, 3, 1e-12);
  EXPECT_NEAR(over_distance[6].error, 0.4, 1e-12);
  EXPECT_NEAR(over_distance[7].error, 0.2, 1e-12);
  EXPECT_NEAR(over_distance[8].error, 0, 1e-12);
}

TEST(Drift, needsPairs) { EXPECT_THROW(driftOf({}, AlignmentKind::Yaw), std::invalid_argument); }
}  // namespace
}  // namespace scanloom::drift_unittest
