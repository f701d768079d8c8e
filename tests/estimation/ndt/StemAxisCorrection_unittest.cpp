#include "estimation/ndt/internal/StemAxisCorrection.h"

#include "estimation/ndt/ForestCorrections.h"
#include "estimation/ndt/NdtMap.h"
#include "estimation/ndt/Registration.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scanloom::stem_axis_correction_unittest
{
namespace
{
struct Stem
{
  double x, y, radius;
};

/** Where rays from `eye`, evenly spread over the stem's width, meet it; rings 5 cm apart. */
void look(const Eigen::Vector3d& eye, const Stem& stem, std::vector<Eigen::Vector3f>& points)
{
  const Eigen::Vector2d axis(stem.x, stem.y), sight = (axis - eye.head<2>()).normalized();
  const Eigen::Vector2d side(-sight.y(), sight.x());
  for (double z = 0.025; z < 4; z += 0.05)
    for (double across = -0.95; across < 1; across += 0.1)
    {
      const Eigen::Vector2d p = axis + stem.radius * (across * side - std::sqrt(1 - across * across) * sight);
      points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(z));
    }
}

View viewOf(const Stem& stem, const Eigen::Vector3d& eye)
{
  View view{{}, eye, {}, forestCorrections()};
  look(eye, stem, view.points);
  return view;
}

/** A round bush in the middle of a cell: where rays along -x hit its leaves. Of a ray exp(-extinction depth) is left.
 */
View bushOfEvenLeaves(double radius, double extinction)
{
  constexpr double kStep = 0.002, kPointsPerStep = 0.1;  // m
  View view{{}, Eigen::Vector3d(8.5, 0.5, 2), {}, forestCorrections()};
  for (double z = 0.025; z < 1; z += 0.05)
    for (double across = -0.975; across < 1; across += 0.05)
    {
      const double chord = 2 * radius * std::sqrt(1 - across * across);
      double points = 0.6;  // the first point is not deeper than the others
      for (double depth = kStep / 2; depth < chord; depth += kStep)
      {
        points += kPointsPerStep * std::exp(-extinction * depth);
        if (points < 1) continue;
        points -= 1;
        view.points.emplace_back(static_cast<float>(0.5 + chord / 2 - depth), static_cast<float>(0.5 + radius * across),
                                 static_cast<float>(z));
      }
    }
  return view;
}

/** Stems around a lane of 6 m along x, all in the middle of a cell of 1 m. */
std::vector<Stem> stand()
{
  std::vector<Stem> stems;
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j)
      if (std::abs(j) > 3 && (7 * i + 3 * j) % 5 == 0) stems.push_back({i + 0.5, j + 0.5, 0.05 + 0.01 * ((i + j) & 7)});
  return stems;
}

/** Of the stand, in the frame of the eye. */
View viewFrom(const Eigen::Vector3d& eye)
{
  View view{{}, eye, {}, forestCorrections()};
  for (const Stem& stem : stand()) look(eye, stem, view.points);
  return movedBy(Rigid::fromXyzYawPitchRoll(-eye.x(), -eye.y(), -eye.z(), 0, 0, 0), view);
}

double stepFound(const View& target, const View& source, double step)
{
  const Rigid guess = Rigid::fromXyzYawPitchRoll(step, 0, 0, 0, 0, 0);
  return align(NdtMap({target}, {}), NdtMap({source}, {}), guess, {}).target_T_source.translation.x();
}
}  // namespace

TEST(StemAxisCorrection, aStemStandsAtItsAxisFromWhereverItIsSeen)
{
  for (const double radius : {0.04, 0.1, 0.2})
    for (int bearing = 0; bearing < 360; bearing += 30)
    {
      const Stem stem{0.5, 0.5, radius};
      const double angle = bearing * M_PI / 180;
      const Eigen::Vector3d eye(0.5 + 8 * std::cos(angle), 0.5 + 8 * std::sin(angle), 2);
      const NdtMap map({viewOf(stem, eye)}, {});
      ASSERT_EQ(map.cells().size(), 4u);
      for (const GaussianCell& cell : map.cells())
        EXPECT_LT((cell.mean.head<2>() - Eigen::Vector2d(0.5, 0.5)).norm(), 0.1 * radius) << radius << ' ' << bearing;
    }
}

TEST(StemAxisCorrection, aBushIsMovedByWhatIsMissingOfItsFarSide)
{
  constexpr double kRadius = 0.2, kNoiseAllowedFor = 0.045;  // m
  for (const double extinction : {0., 3., 10., 30., 60.})    // 1/m
  {
    View view = bushOfEvenLeaves(kRadius, extinction);
    EXPECT_LT(std::abs(NdtMap({view}, {}).cells().front().mean.x() - 0.5), kNoiseAllowedFor) << extinction;
    view.viewpoint.reset();
    const double seen = NdtMap({view}, {}).cells().front().mean.x() - 0.5;
    EXPECT_TRUE(extinction < 30 || seen > 0.12) << "what this is about: " << seen;
  }
}

namespace
{
constexpr double kAssumed = 0.03;  // m, depth of what few points are on; like ten stems of it

/** Two points far away, 60 cm apart along `direction`, and six stems nearby. */
View withTwoFarPoints(const Eigen::Vector3f& direction, double radius)
{
  const Eigen::Vector3f middle(0.5F, 30.5F, 2.5F);
  View view{
      {middle - 0.3F * direction, middle + 0.3F * direction}, Eigen::Vector3d(0.5, 0.5, 2.5), {}, forestCorrections()};
  for (const double x : {-5.5, -3.5, -1.5, 2.5, 4.5, 6.5}) look(*view.viewpoint, {x, 3.5, radius}, view.points);
  return view;
}

/** How much farther away the two points are than they were seen. */
double farPointsMoved(const View& view)
{
  const NdtMap map({view}, with(&NdtOptions::min_points, 2));
  double farthest = 0;
  for (const GaussianCell& cell : map.cells()) farthest = std::max(farthest, cell.mean.y());
  return farthest - 30.5;
}
}  // namespace

TEST(StemAxisCorrection, twoFarPointsLieAsDeepAsTheStemsNearbyAndTenAssumedOnes)
{
  constexpr double kRadius = 0.1;
  constexpr int kCells = 4 * 6;  // of six stems, 4 m high
  const double depth = (kCells * M_PI / 4 * kRadius + 10 * kAssumed) / (kCells + 10);
  EXPECT_NEAR(farPointsMoved(withTwoFarPoints({0, 0, 1}, kRadius)), depth, 0.003);
  EXPECT_NEAR(farPointsMoved(withTwoFarPoints({1, 0, 0}, kRadius)), depth, 0.003) << "side by side";
}

TEST(StemAxisCorrection, twoFarPointsLieAsDeepAsIsAssumedIfNoStemIsNearby)
{
  View view = withTwoFarPoints({0, 0, 1}, 0.1);
  view.points.resize(2);
  EXPECT_NEAR(farPointsMoved(view), kAssumed, 1e-4);
}

TEST(StemAxisCorrection, withoutAViewpointOrTheCorrectionAStemStandsWhereItIsTouched)
{
  View unplaced = viewOf({0.5, 0.5, 0.2}, {8.5, 0.5, 2}), uncorrected = unplaced;
  unplaced.viewpoint.reset();
  uncorrected.corrections = {};
  for (const View& view : {unplaced, uncorrected})
  {
    const NdtMap map({view}, {});
    for (const GaussianCell& cell : map.cells()) EXPECT_NEAR(cell.mean.x(), 0.5 + M_PI / 4 * 0.2, 1e-3);
  }
}

TEST(StemAxisCorrection, wallsAndFoliageStay)
{
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 400; ++i)
  {
    const float a = static_cast<float>(i % 20) / 20 + 0.02F, b = static_cast<float>(i / 20) / 20 + 0.02F;
    points.emplace_back(0.5F, a, b);                               // a wall
    points.emplace_back(3 + a, b, static_cast<float>(i % 7) / 7);  // a bush
  }
  constexpr std::int64_t kMetre = 65536;
  const std::vector<Bin> before = countInto({&points[0].x(), &points[0].y(), &points[0].z(), 3, points.size()}, kMetre);
  const std::vector<Bin> after = correctNearSideBias(before, {1, {10, 0.5, 0.5}, Eigen::Vector3d::UnitZ(), 4});
  ASSERT_EQ(after.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(after[i].moments.x, before[i].moments.x);
}

TEST(StemAxisCorrection, thePathPastStemsIsNotShortened)
{
  const View here = viewFrom({0, 0, 2}), there = viewFrom({3, 0, 2});
  View here_plain = here, there_plain = there;
  here_plain.viewpoint.reset(), there_plain.viewpoint.reset();
  EXPECT_LT(stepFound(here_plain, there_plain, 3), 3 - 0.008) << "what this is about";
  EXPECT_NEAR(stepFound(here, there, 3), 3, 0.001);
}

TEST(View, pointsAreToldApartBySensor)
{
  PointCloud cloud;
  cloud.resize(3);
  cloud.sensor_id[1] = 1;
  cloud.sensor_id[2] = 7;
  const auto views =
      viewsOf(cloud, {Rigid::fromXyzYawPitchRoll(1, 0, 0, 0, 0, 0), Rigid::fromXyzYawPitchRoll(2, 0, 0, 0, 0, 0)});
  ASSERT_EQ(views.size(), 3u);
  for (const View& view : views) EXPECT_EQ(view.points.size(), 1u);
  EXPECT_EQ(views[1].viewpoint->x(), 2);
  EXPECT_FALSE(views[2].viewpoint);
}
}  // namespace scanloom::stem_axis_correction_unittest
