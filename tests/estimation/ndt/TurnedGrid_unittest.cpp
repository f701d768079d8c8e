#include "estimation/ndt/NdtMap.h"
#include "estimation/ndt/Registration.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scanloom::turned_grid_unittest
{
namespace
{
/** Leaves, spread evenly in crowns of 3 m that stand at the same places for every `seed`; seen from x = `along`. */
View crownsFrom(double along, unsigned seed)
{
  std::mt19937 places(1), leaves(seed);
  std::uniform_real_distribution<double> even(-1, 1);
  View view;
  for (int crown = 0; crown < 60; ++crown)
  {
    const Eigen::Vector3d middle{15 * even(places), 15 * even(places), 3 * even(places)};
    for (int leaf = 0; leaf < 400;)
    {
      const Eigen::Vector3d p{even(leaves), even(leaves), even(leaves)};
      if (p.norm() > 1) continue;
      view.points.push_back((middle + 1.5 * p - along * Eigen::Vector3d::UnitX()).cast<float>());
      ++leaf;
    }
  }
  return view;
}

/** m, root mean square along x over places up to one cell ahead of the map's. */
double errorWith(Grid grid)
{
  constexpr int kPlaces = 10;
  RegistrationOptions options;
  options.d2 = options.first_d2 = 1;
  const NdtMap map({crownsFrom(0, 2)}, {});
  double squares = 0;
  for (int i = 0; i < kPlaces; ++i)
  {
    const double along = static_cast<double>(i) / kPlaces;
    const NdtMap scan({crownsFrom(along, 3)}, {}, grid);
    const Rigid truth = Rigid::fromXyzYawPitchRoll(along, 0, 0, 0, 0, 0);
    squares += std::pow(align(map, scan, truth, options).target_T_source.translation.x() - along, 2) / kPlaces;
  }
  return std::sqrt(squares);
}

TEST(TurnedGrid, doesNotPullScansOfFoliageTowardsTheMapsGrid)
{
  const double straight = errorWith(Grid::Straight), turned = errorWith(Grid::Turned);
  RecordProperty("straight_mm", std::to_string(1000 * straight));
  RecordProperty("turned_mm", std::to_string(1000 * turned));

  EXPECT_LT(turned, straight / 3);
}

TEST(TurnedGrid, hasCellsInTheFrameOfThePoints)
{
  const View view = crownsFrom(0, 2);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : view.points) mean += p.cast<double>() / static_cast<double>(view.points.size());

  Eigen::Vector3d of_cells = Eigen::Vector3d::Zero();
  const NdtMap map({view}, with(&NdtOptions::min_points, 1), Grid::Turned);
  for (const GaussianCell& cell : map.cells()) of_cells += cell.points * cell.mean / static_cast<double>(map.points());

  EXPECT_LT((of_cells - mean).norm(), 1e-4);
}

TEST(TurnedGrid, findsTheCellOfAPoint)
{
  const NdtMap map({crownsFrom(0, 2)}, {}, Grid::Turned);
  int own = 0;
  for (std::uint32_t i = 0; i < map.cells().size(); ++i)
  {
    std::uint32_t found = 0;
    own += map.findAround(map.indexOf(map.cells()[i].mean), 1, &found) == 1 && found == i ? 1 : 0;
  }
  EXPECT_EQ(own, static_cast<int>(map.cells().size()));
}

TEST(TurnedGrid, hasAllPointsInLargerCellsToo)
{
  const NdtMap map({crownsFrom(0, 2)}, {}, Grid::Turned);
  const NdtMap coarse = map.coarser(2);
  const GaussianCell& cell = coarse.cells()[coarse.cells().size() / 2];
  std::uint32_t found = 0;

  EXPECT_EQ(coarse.points(), map.points());
  EXPECT_EQ(coarse.findAround(coarse.indexOf(cell.mean), 1, &found), 1u);
}

TEST(TurnedGrid, takesNoFurtherPoints)
{
  NdtMap map({crownsFrom(0, 2)}, {}, Grid::Turned);
  EXPECT_THROW(map.add(binned({crownsFrom(0, 3)}, {})), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::turned_grid_unittest
