#include "base/positions/Alignment.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <mrpt/tfest/se3.h>

#include <cmath>

namespace scanloom::alignment_unittest
{
namespace
{
PositionPair pair(const Eigen::Vector3d& map_p, const Eigen::Vector3d& reference_p) { return {{}, map_p, reference_p}; }

TEST(Alignment, turnsAQuarterForPointsAQuarterTurnApart)
{
  const Rigid reference_T_map =
      align({pair({1, 0, 0}, {5, 8, 2}), pair({-1, 0, 0}, {5, 6, 2})}, AlignmentKind::Yaw).reference_T_map;

  EXPECT_NEAR(reference_T_map.yawPitchRoll()[0], M_PI / 2, 1e-12);
  EXPECT_TRUE(reference_T_map.translation.isApprox(Eigen::Vector3d(5, 7, 2), 1e-12));
}

TEST(Alignment, byYawNeverTilts)
{
  const Alignment alignment = align({pair({0, 0, 0}, {0, 0, 0}), pair({1, 0, 0}, {0.8, 0, 0.6})}, AlignmentKind::Yaw);

  EXPECT_TRUE(alignment.reference_T_map.rotation.isApprox(Eigen::Quaterniond::Identity(), 1e-12));
}

/** Deterministic, and no rigid transform between the two. */
std::vector<PositionPair> scattered()
{
  std::vector<PositionPair> pairs;
  const Rigid reference_T_map = Rigid::fromXyzYawPitchRoll(3, -2, 7, 1.1, -0.4, 0.6);
  for (int i = 0; i < 30; ++i)
  {
    const Eigen::Vector3d p(std::sin(1.7 * i) * 9, std::cos(2.9 * i) * 5, std::sin(0.3 * i * i) * 2);
    const Eigen::Vector3d noise(std::cos(5.1 * i), std::sin(7.7 * i), std::cos(i * i));
    pairs.push_back(pair(p, reference_T_map * p + 0.2 * noise));
  }
  return pairs;
}

mrpt::math::TPoint3Df single(const Eigen::Vector3d& p)
{
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

TEST(Alignment, bySe3IsThatOfMrpt)
{
  mrpt::tfest::TMatchingPairList matches;
  for (const PositionPair& p : scattered())
  {
    mrpt::tfest::TMatchingPair match;
    match.global = single(p.reference_p);
    match.local = single(p.map_p);
    matches.push_back(match);
  }
  mrpt::poses::CPose3DQuat theirs;
  double scale = 0;
  ASSERT_TRUE(mrpt::tfest::se3_l2(matches, theirs, scale, true));

  const Rigid ours = align(scattered(), AlignmentKind::Se3).reference_T_map;

  EXPECT_NEAR(ours.translation.x(), theirs.x(), 1e-5);
  EXPECT_NEAR(ours.translation.y(), theirs.y(), 1e-5);
  EXPECT_NEAR(ours.translation.z(), theirs.z(), 1e-5);
  const auto& q = theirs.quat();
  EXPECT_LT(ours.rotation.angularDistance(Eigen::Quaterniond(q.r(), q.x(), q.y(), q.z())), 1e-5);
}

TEST(Alignment, tellsThatAStraightPathLeavesTheRollOpen)
{
  const std::vector<PositionPair> line{pair({0, 0, 0}, {0, 0, 0}), pair({2, 0, 0}, {2, 0, 0})};

  const Alignment straight = align(line, AlignmentKind::Se3);
  EXPECT_EQ(straight.lever, 0);
  EXPECT_TRUE(std::isinf(straight.condition));
  EXPECT_NEAR(align(line, AlignmentKind::Yaw).lever, 1, 1e-12);
}

TEST(Alignment, isConditionedByTheSpreadAcrossThePath)
{
  // Variances 8, 2 and 0 m^2: 10 about the axis that is fixed best, 2 about the worst.
  const Alignment cross = align({pair({4, 0, 0}, {4, 0, 0}), pair({-4, 0, 0}, {-4, 0, 0}), pair({0, 2, 0}, {0, 2, 0}),
                                 pair({0, -2, 0}, {0, -2, 0})},
                                AlignmentKind::Se3);

  EXPECT_NEAR(cross.lever, std::sqrt(2), 1e-12);
  EXPECT_NEAR(cross.condition, 5, 1e-12);
}
}  // namespace
}  // namespace scanloom::alignment_unittest
