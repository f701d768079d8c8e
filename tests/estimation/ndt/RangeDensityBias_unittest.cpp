#include "estimation/ndt/internal/RangeDensityBias.h"

#include "estimation/ndt/ForestCorrections.h"
#include "estimation/ndt/NdtMap.h"
#include "estimation/ndt/Registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scanloom::range_density_bias_unittest
{
namespace
{
constexpr double kExtinction = 0.6;  // 1/m, of these leaves

/**
 * Where rays hit leaves in a cube of 1 m, or in a ball of that radius in it. Of evenly spread points those stay that a
 * ray reaches: rays get fewer with 1 / r^2, and with exp(-mu s) on the way s through leaves.
 */
void addLeaves(const Eigen::Vector3d& corner, double radius, const Eigen::Vector3d& eye, std::mt19937& random,
               View& view)
{
  std::uniform_real_distribution<double> even(0, 1);
  const Eigen::Vector3d middle = corner + Eigen::Vector3d::Constant(0.5);
  const double nearest = (middle - eye).norm() - 0.9;
  const auto share = [&](double r) { return std::exp(-kExtinction * (r - nearest)) * nearest * nearest / (r * r); };
  for (int i = 0; i < 2000; ++i)
  {
    // Braces: drawn in this order on every processor.
    const Eigen::Vector3d in_cube{even(random), even(random), even(random)};
    const Eigen::Vector3d p = corner + in_cube;
    if ((p - middle).norm() < radius && even(random) < share((p - eye).norm())) view.points.push_back(p.cast<float>());
  }
}

/** A hedge on both sides of a lane along x, seen from x = `along`, in the frame of the eye. */
View hedgesFrom(double along, unsigned seed)
{
  std::mt19937 random(static_cast<unsigned>(1000 * along) + seed);
  const Eigen::Vector3d eye(along, 0.3, 1.4);
  View view{{}, eye, {}, forestCorrections()};
  for (int x = -10; x < 14; ++x)
    for (const int y : {-6, -5, 4, 5})
      for (int z = 0; z < 3; ++z)
        if ((x * 7 + y * 3 + z * 5) % 4 != 0) addLeaves(Eigen::Vector3d(x, y, z), 0.45, eye, random, view);
  return movedBy(Rigid::fromXyzYawPitchRoll(-eye.x(), -eye.y(), -eye.z(), 0, 0, 0), view);
}

View withoutViewpoint(View view)
{
  view.viewpoint.reset();
  return view;
}

double stepFound(const View& target, const View& source, double step)
{
  const Rigid guess = Rigid::fromXyzYawPitchRoll(step, 0, 0, 0, 0, 0);
  return align(NdtMap({target}, {}), NdtMap({source}, {}), guess, {}).target_T_source.translation.x();
}
}  // namespace

TEST(RangeDensityBias, leavesHaveTheirMeanHalfAsFarFromTheMiddleFromWhereverTheyAreSeen)
{
  for (int bearing = 0; bearing < 360; bearing += 40)
  {
    std::mt19937 random(7);
    const double angle = bearing * M_PI / 180;
    const Eigen::Vector3d middle(0.5, 0.5, 0.5), away(std::cos(angle), std::sin(angle), 0.2);
    View view{{}, middle + 6 * away, {}, forestCorrections()};
    for (int i = 0; i < 20; ++i) addLeaves({0, 0, 0}, 1, *view.viewpoint, random, view);
    const Eigen::Vector3d seen = NdtMap({withoutViewpoint(view)}, {}).cells().front().mean;
    const Eigen::Vector3d moved = NdtMap({view}, {}).cells().front().mean;
    EXPECT_GT((seen - middle).dot(away.normalized()), 0.06) << "what this is about";
    EXPECT_LT((moved - (seen + middle) / 2).norm(), 0.015) << bearing;
  }
}

TEST(RangeDensityBias, thePathThroughFoliageIsNotShortened)
{
  constexpr unsigned kHedges = 8;  // in each the error is another, of 5 mm
  double seen = 0, moved = 0;
  for (unsigned seed = 1; seed <= kHedges; ++seed)
  {
    const View here = hedgesFrom(0, seed), there = hedgesFrom(4, seed);
    seen += stepFound(withoutViewpoint(here), withoutViewpoint(there), 4) / kHedges;
    moved += stepFound(here, there, 4) / kHedges;
  }
  EXPECT_LT(seen, 4 - 0.008) << "what this is about";
  EXPECT_NEAR(moved, 4, 0.005);
}

TEST(RangeDensityBias, aWallStaysInItsPlane)
{
  View view{{}, Eigen::Vector3d(5, 4, 1), {}, forestCorrections()};
  for (float y = 0.01F; y < 1; y += 0.05F)
    for (float z = 0.01F; z < 1; z += 0.05F) view.points.emplace_back(0.5F, y, z);
  EXPECT_NEAR(NdtMap({view}, {}).cells().front().mean.x(), 0.5, 1e-4);
}

TEST(RangeDensityBias, threePointsStay)
{
  View view{{{0.2F, 0.5F, 0.5F}, {0.5F, 0.4F, 0.5F}, {0.9F, 0.6F, 0.4F}}, Eigen::Vector3d(5, 0, 0)};
  view.corrections.shift_of = forestCorrections().shift_of;
  EXPECT_EQ(binned({view}, {}).bins.front().moments.x, binned({withoutViewpoint(view)}, {}).bins.front().moments.x);
}
}  // namespace scanloom::range_density_bias_unittest
