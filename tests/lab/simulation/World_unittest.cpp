#include "lab/simulation/internal/World.h"
#include "lab/simulation/internal/Random.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <map>

namespace scanloom::world_unittest
{
namespace
{
constexpr double kMaxRange = 50;

World worldAround(const ForestOptions& options) { return World(Ground(GroundOptions{}), options, {{0, 0}}, 1); }

Ray rayFrom(const World& world, double azimuth, double altitude, double height = 2.5)
{
  return {{0.13, 0.17, world.ground().height(0.13, 0.17) + height},
          {std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude), std::sin(altitude)}};
}

std::vector<Ray> fan(const World& world)
{
  std::vector<Ray> rays;
  for (int column = 0; column < 512; ++column)
    for (int beam = 0; beam < 64; ++beam)
      rays.push_back(rayFrom(world, 2 * M_PI * column / 512, M_PI / 4 * (1 - beam / 31.5)));
  return rays;
}

TEST(World, isMetWhereItsSurfacesAre)
{
  const World world = worldAround({});
  std::map<Surface, int> met;
  std::uint64_t draw = 0;
  for (const Ray& ray : fan(world))
  {
    const auto hit = world.cast({ray, kMaxRange, ++draw});
    if (!hit) continue;
    ++met[hit->surface];
    const Eigen::Vector3d p = ray.at(hit->range);
    EXPECT_GE(hit->cosine_incidence, 0);
    EXPECT_LE(hit->cosine_incidence, 1 + 1e-12);
    EXPECT_GT(p.z(), world.ground().height(p.x(), p.y()) - 1e-4) << "nothing is seen through the ground";
    if (hit->surface == Surface::Ground)
    {
      EXPECT_NEAR(p.z(), world.ground().height(p.x(), p.y()), 1e-5);
    }
    if (hit->surface == Surface::Crown)
    {
      const Eigen::Array3i voxel = world.foliage().voxels().voxelAt(p);
      EXPECT_FALSE(world.foliage().voxels().at(voxel.x(), voxel.y(), voxel.z()).isEmpty());
    }
  }
  for (const Surface surface : {Surface::Ground, Surface::Stem, Surface::Branch, Surface::Crown, Surface::Undergrowth})
    EXPECT_GT(met[surface], 20) << static_cast<int>(surface);
}

TEST(World, givesTheNearestOfItsSurfaces)
{
  const World world = worldAround({});
  std::uint64_t draw = 0;
  for (const Ray& ray : fan(world))
  {
    const auto hit = world.cast({ray, kMaxRange, ++draw});
    const double range = hit ? hit->range : kMaxRange;
    const auto wood = world.wood().cast(ray, kMaxRange);
    EXPECT_LE(range, world.ground().intersect(ray, kMaxRange).value_or(kMaxRange));
    EXPECT_LE(range, wood ? wood->range + 1e-3 : kMaxRange);
  }
}

TEST(World, hasCrownsAboveEightMetresInTheSparseStand)
{
  const World world = worldAround({});
  std::uint64_t draw = 0;
  for (const Ray& ray : fan(world))
    if (const auto hit = world.cast({ray, kMaxRange, ++draw}); hit && hit->surface == Surface::Crown)
    {
      const Eigen::Vector3d p = ray.at(hit->range);
      EXPECT_GT(p.z() - world.ground().height(p.x(), p.y()), 7.4) << "but for half a voxel and the slope";
    }
}

TEST(World, answersTheSameOnAnyThreadAndOtherwiseForAnotherDraw)
{
  const World world = worldAround({});
  const std::vector<Ray> rays = fan(world);
  const auto castAll = [&](std::uint64_t draw)
  {
    std::vector<double> ranges(rays.size());
    tbb::parallel_for(std::size_t{0}, rays.size(),
                      [&](std::size_t i)
                      {
                        const auto hit = world.cast({rays[i], kMaxRange, draw + i});
                        ranges[i] = hit ? hit->range : 0;
                      });
    return ranges;
  };
  std::vector<double> one_by_one;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const auto hit = world.cast({rays[i], kMaxRange, i});
    one_by_one.push_back(hit ? hit->range : 0);
  }
  EXPECT_EQ(castAll(0), one_by_one);
  EXPECT_NE(castAll(1'000'000), one_by_one);
}

/** Algebraic fit (I. Kasa: A Circle Fitting Procedure and Its Error Analysis, IEEE TIM 1976). */
double fittedDiameter(const std::vector<Eigen::Vector2d>& points)
{
  Eigen::MatrixX3d terms(points.size(), 3);
  Eigen::VectorXd squares(points.size());
  for (Eigen::Index i = 0; i < terms.rows(); ++i)
  {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)];
    terms.row(i) << 2 * p.x(), 2 * p.y(), 1;
    squares[i] = p.squaredNorm();
  }
  const Eigen::Vector3d solution = terms.colPivHouseholderQr().solve(squares);
  return 2 * std::sqrt(solution.z() + solution.head<2>().squaredNorm());
}

/** As a forester would measure them from outside: from what rays at breast height meet. */
TEST(World, hasTheStemDiametersOfItsTable)
{
  ForestOptions options;
  options.foliage.undergrowth_cover = 0;
  options.trees.branches.dead_branches = 0;
  const World world = worldAround(options);
  int measured = 0;
  double largest_error = 0;
  for (std::uint32_t i = 0; i < world.stems().size(); ++i)
  {
    const Stem& stem = world.stems()[i];
    const Eigen::Vector3d breast = stem.foot + 1.3 * stem.axis;
    const Eigen::Vector3d eye(breast.x() - 3, breast.y(), breast.z());
    const Eigen::Vector3d u = stem.axis.unitOrthogonal(), v = stem.axis.cross(u);
    std::vector<Eigen::Vector2d> across;
    for (double side = -0.12; side <= 0.12; side += 0.002)
    {
      const Ray ray{eye, (breast + Eigen::Vector3d(0, side, 0) - eye).normalized()};
      const auto hit = world.cast({ray, 4, 1});
      if (hit && hit->surface == Surface::Stem && hit->id == i && hit->cosine_incidence > 0.3)
        across.emplace_back((ray.at(hit->range) - breast).dot(u), (ray.at(hit->range) - breast).dot(v));
    }
    if (across.size() < 20) continue;  // another stem stands in between
    ++measured;
    EXPECT_NEAR(fittedDiameter(across), stem.diameter, 5e-4) << "stem " << i;
    largest_error = std::max(largest_error, std::abs(fittedDiameter(across) - stem.diameter));
  }
  RecordProperty("stems", measured);
  RecordProperty("largest_error_mm", fmt::format("{:.3f}", 1e3 * largest_error));
  EXPECT_GT(measured, 500);
}
}  // namespace
}  // namespace scanloom::world_unittest
