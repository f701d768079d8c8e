#include "lab/evaluation/internal/PoseErrors.h"

#include "base/core/Angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::pose_errors_unittest
{
namespace
{
Rigid at(double x, double y, double z, double yaw_deg = 0)
{
  return Rigid::fromXyzYawPitchRoll(x, y, z, yaw_deg * kDegree, 0, 0);
}

/** On the corners of a square of 2 m, up and down by 1 m in turns: no rigid motion makes that better. */
std::vector<PosePair> saddle()
{
  const Rigid elsewhere = at(100, 50, -7, 33);
  return {{elsewhere * at(0, 0, 1), at(0, 0, 0)},
          {elsewhere * at(2, 0, -1), at(2, 0, 0)},
          {elsewhere * at(2, 2, 1, 3), at(2, 2, 0)},
          {elsewhere * at(0, 2, -1, -1), at(0, 2, 0)}};
}

TEST(PoseErrors, absoluteOnesAreThoseAfterTheBestAlignment)
{
  for (const AlignmentKind kind : {AlignmentKind::Yaw, AlignmentKind::Se3})
  {
    const PoseErrors errors = absoluteErrors(saddle(), kind);

    EXPECT_NEAR(errors.metres.rmse, 1, 1e-12);
    EXPECT_NEAR(errors.metres.largest, 1, 1e-12);
    EXPECT_NEAR(errors.degrees->rmse, std::sqrt(10.0 / 4), 1e-9);  // 0, 0, 3 and 1 deg
    EXPECT_NEAR(errors.degrees->largest, 3, 1e-9);
  }
}

TEST(PoseErrors, relativeOnesAreThoseOfEachStep)
{
  // After 1.5 m steps of 1.2 m become 1.3, 1.1 and 1.2 m; before the last one the estimate is turned by 2 deg, which
  // stays.
  const std::vector<PosePair> pairs{{at(-1.5, 0, 0), at(-1.5, 0, 0)},
                                    {at(0, 0, 0), at(0, 0, 0)},
                                    {at(1.3, 0, 0), at(1.2, 0, 0)},
                                    {at(2.4, 0, 0, 2), at(2.4, 0, 0)},
                                    {at(3.6, 0, 0, 2), at(3.6, 0, 0)}};

  const PoseErrors errors = relativeErrors(pairs);

  const double aside = 2 * 1.2 * std::sin(1 * kDegree);  // the last step, seen 2 deg askew
  EXPECT_EQ(errors.compared, 3U);
  EXPECT_NEAR(errors.metres.rmse, std::sqrt((0.01 + 0.01 + aside * aside) / 3), 1e-12);
  EXPECT_NEAR(errors.degrees->rmse, std::sqrt(4.0 / 3), 1e-9);
}

TEST(PoseErrors, relativeOnesBeginWhereThePathFirstReachesAMetre)
{
  // By evo's filter_pairs_by_path: 0.6 m a pose, so pairs are (2, 4) and (4, 6); the step into 1 counts in none.
  std::vector<PosePair> pairs;
  for (int i = 0; i < 7; ++i) pairs.push_back({at(0.6 * i, 0, 0), at(0.6 * i, 0, i == 0 ? 5 : 0)});
  pairs[6].reference_T_body.translation.z() = 0.3;

  const PoseErrors errors = relativeErrors(pairs);

  EXPECT_EQ(errors.compared, 2U);
  EXPECT_NEAR(errors.metres.rmse, std::sqrt(0.09 / 2), 1e-12);
}

TEST(PoseErrors, relativeOnesOfPositionsCompareDistances)
{
  const std::vector<PositionPair> pairs{
      {{}, {-1, 0, 0}, {0, 0, 0}}, {{}, {0, 0, 0}, {0, 0, 0}}, {{}, {1, 0, 0}, {0, 3, 4}}, {{}, {1, 2, 0}, {0, 3, 2}}};

  const PoseErrors errors = relativeErrors(pairs);

  EXPECT_NEAR(errors.metres.rmse, std::sqrt((16.0 + 0) / 2), 1e-12);  // 1 for 5 m, 2 for 2 m
  EXPECT_FALSE(errors.degrees);
}

TEST(PoseErrors, nothingIsComparedOnAPathShorterThanAMetre)
{
  const std::vector<PosePair> pairs{{at(0, 0, 0), at(0, 0, 0)}, {at(0.9, 0, 0), at(0.9, 0, 0)}};
  EXPECT_EQ(relativeErrors(pairs).compared, 0U);
}

TEST(PoseErrors, ofAnOffsetPointAreThoseOfItsOwnPath)
{
  // Both turn by 90 deg, the estimate on the spot, the reference too: a point 1 m ahead moves alike.
  const Trajectory turn{{Timestamp{0s}, at(0, 0, 0)}, {Timestamp{1s}, at(0, 0, 0, 90)}};

  const std::vector<PosePair> pairs = posePairs(turn, {1, 0, 0}, turn);

  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_TRUE(pairs[1].map_T_body.translation.isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(pairs[1].reference_T_body.translation.isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
}
}  // namespace
}  // namespace scanloom::pose_errors_unittest
