#include "base/positions/PositionTrack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::position_track_unittest
{
namespace
{
/** A quarter turn to the left about the origin in a second. */
Trajectory turning()
{
  return {{Timestamp{0s}, {}},
          {Timestamp{1s}, {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())), {0, 0, 0}}}};
}

TEST(PositionTrack, thePrismFollowsTheInterpolatedRotation)
{
  const auto pairs = pairsAtReference(turning(), {1, 0, 0}, {{Timestamp{500ms}, {7, 8, 9}}});

  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_TRUE(pairs[0].map_p.isApprox(Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0), 1e-12));
  EXPECT_EQ(pairs[0].reference_p, Eigen::Vector3d(7, 8, 9));
}

TEST(PositionTrack, pairsNothingOutsideTheEstimateAndInItsGaps)
{
  const Trajectory gap{{Timestamp{1s}, {}}, {Timestamp{3s}, {}}, {Timestamp{5001ms}, {}}, {Timestamp{6s}, {}}};
  PositionTrack reference;
  for (Duration t{500ms}; t < 8s; t += 1s) reference.push_back({Timestamp{t}, {0, 0, 0}});

  const auto pairs = pairsAtReference(gap, {0, 0, 0}, reference);

  ASSERT_EQ(pairs.size(), 3U);  // 1.5, 2.5 and 5.5 s; from 3 to 5.001 s is wider than 2 s
  EXPECT_EQ(pairs[1].stamp, Timestamp{2500ms});
  EXPECT_EQ(pairs[2].stamp, Timestamp{5500ms});
  EXPECT_NEAR(coverage(pairs, reference), 1 / 7.0, 1e-12);  // 1.5 to 2.5 s, of 0.5 to 7.5 s
}
}  // namespace
}  // namespace scanloom::position_track_unittest
