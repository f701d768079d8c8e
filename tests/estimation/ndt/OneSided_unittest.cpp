/** RegistrationResult::viewpoint_bias against what a registration does when the leaves are seen nearer than they are.
 */
#include "estimation/ndt/Registration.h"

#include <gtest/gtest.h>

#include <random>

namespace scanloom::one_sided_unittest
{
namespace
{
/** Tufts in the middle of cells of 1 m, from 4 to 10 m around the origin; only to the left, or to both sides. Each is
 * `nearer` of its deviations along the view nearer than it is. */
NdtMap tufts(bool both_sides, double nearer)
{
  constexpr double kDeviation = 0.12;  // m
  std::mt19937_64 random(3);
  std::normal_distribution<double> leaf(0, kDeviation);
  std::vector<Eigen::Vector3f> points;
  for (int x = -10; x < 10; ++x)
    for (int y = -10; y < 10; ++y)
      for (int z = -1; z <= 1; ++z)
      {
        const Eigen::Vector3d centre(x + 0.5, y + 0.5, z + 0.5);
        const bool is_there = (7 * x + 3 * y + 5 * z) % 4 == 0 && centre.norm() > 4 && centre.norm() < 10;
        const Eigen::Vector3d shift = -nearer * kDeviation * centre.normalized();
        for (int i = 0; i < 40; ++i)
        {
          const Eigen::Vector3d p = centre + Eigen::Vector3d(leaf(random), leaf(random), leaf(random)) + shift;
          if (is_there && (both_sides || y > 0)) points.push_back(p.cast<float>());
        }
      }
  return NdtMap(points, NdtOptions{});
}
}  // namespace

TEST(RegistrationOfWhatIsSeenFromOneSide, movesByOneSidedTimesTheShareOfTheDepthThatIsHidden)
{
  constexpr double kNearer = 0.1;
  const NdtMap target = tufts(false, 0);
  const RegistrationResult seen = align(target, tufts(false, 0), Rigid::identity(), {});
  const RegistrationResult displaced = align(target, tufts(false, kNearer), Rigid::identity(), {});
  const Eigen::Vector3d moved = (displaced.target_T_source.translation - seen.target_T_source.translation) / kNearer;
  EXPECT_GT(std::abs(seen.viewpoint_bias.y()), 0.05);
  EXPECT_NEAR(moved.y(), -seen.viewpoint_bias.y(), 0.2 * std::abs(seen.viewpoint_bias.y()));
}

TEST(RegistrationOfWhatIsSeenFromBothSides, isHardlyDisplaced)
{
  const auto aside = [](bool both_sides)
  { return std::abs(align(tufts(both_sides, 0), tufts(both_sides, 0), Rigid::identity(), {}).viewpoint_bias.y()); };
  EXPECT_LT(aside(true), 0.2 * aside(false));
}
}  // namespace scanloom::one_sided_unittest
