#include "lab/simulation/internal/Gnss.h"

#include "lab/simulation/internal/Scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::gnss_unittest
{
namespace
{
struct Fixes
{
  std::vector<Eigen::Vector3d> errors;  // m, east, north, up
};

Fixes fixesWith(const GnssOptions& options)
{
  SimulationSettings settings;
  settings.drive.duration = 3000;
  settings.forest.stand.stems_per_hectare = settings.forest.stand.stumps_per_hectare = 0;
  const Scene scene = makeScene(settings, 1);
  const Eigen::Vector3d antenna(-1, 0.5, 4);
  Fixes fixes;
  for (const GnssFix& fix : gnssFixes(scene.scenery.drive(), scene.span, options, antenna, 1))
  {
    const Rigid world_T_body = scene.scenery.drive().at(seconds(fix.stamp - scene.span.start)).world_T_body;
    fixes.errors.push_back(eastNorthUp(fix.at, gnssOrigin()) - enuTWorld() * (world_T_body * antenna));
  }
  return fixes;
}

double meanProduct(const std::vector<Eigen::Vector3d>& errors, std::size_t later)
{
  double sum = 0;
  for (std::size_t i = 0; i + later < errors.size(); ++i) sum += errors[i].dot(errors[i + later]) / 3;
  return sum / static_cast<double>(errors.size() - later);
}
}  // namespace

TEST(Gnss, errsAsStatedAndForHalfAMinute)
{
  const Fixes fixes = fixesWith({2, 0});
  ASSERT_EQ(fixes.errors.size(), 3001U);
  const double variance = meanProduct(fixes.errors, 0);
  EXPECT_NEAR(std::sqrt(variance), 2, 0.3);
  EXPECT_NEAR(meanProduct(fixes.errors, 30) / variance, std::exp(-1), 0.15);
}

TEST(Gnss, withoutErrorIsWhereTheAntennaIs)
{
  for (const Eigen::Vector3d& error : fixesWith({1e-9, 0}).errors) EXPECT_LT(error.norm(), 1e-5);
}

TEST(Gnss, hasOutliersOfTenTimesTheError)
{
  int outliers = 0;
  for (const Eigen::Vector3d& error : fixesWith({0.5, 0.1}).errors) outliers += error.norm() > 3;
  EXPECT_NEAR(outliers, 300, 60);
}
}  // namespace scanloom::gnss_unittest
