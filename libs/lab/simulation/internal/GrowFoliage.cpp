#include "lab/simulation/internal/GrowFoliage.h"

#include "lab/simulation/internal/Random.h"

#include <cmath>

namespace scanloom
{
namespace
{
// Assumed but for the projection.
constexpr double kVoxel = 0.5;  // m: edge of the cubes that foliage is made of; halving it takes eight times the memory
constexpr double kProjection =
    0.5;  // share of its area that a leaf shows to a ray; 0.5 for leaves in all directions alike (Ross 1981)
constexpr double kGaps = 0.4;              // share of a crown's cubes that are empty
constexpr double kUndergrowthPatch = 1.5;  // m: diameter of a patch of undergrowth
constexpr double kUndergrowthLane = 1.4;   // m: no undergrowth within this distance of the machine's path

/** Random extinction per voxel: a share `gaps` is empty, and the mean over all voxels is mean_extinction. */
class Density
{
 public:
  Density(double mean_extinction, double gaps, std::uint64_t seed)
    : mean_of_filled_(mean_extinction / (1 - gaps)), gaps_(gaps), seed_(seed)
  {
  }

  double of(const Eigen::Array3i& voxel) const
  {
    Random random(seed_, RandomStream::Foliage, keyOf(voxel));
    return random.uniform() < gaps_ ? 0 : mean_of_filled_ * random.uniform(0.5, 1.5);
  }

 private:
  double mean_of_filled_, gaps_;
  std::uint64_t seed_;
};

/** Calls visit(x, y, place, distance) for each column of voxels whose centre lies in a circle. */
template <typename Visit>
void forEachColumn(const FoliageVoxels& voxels, const Eigen::Vector2d& centre, double radius, Visit&& visit)
{
  const Eigen::Vector3d around(radius, radius, 0), middle(centre.x(), centre.y(), 0);
  const Eigen::Array3i first = voxels.voxelAt(middle - around), last = voxels.voxelAt(middle + around);
  for (int y = first.y(); y <= last.y(); ++y)
    for (int x = first.x(); x <= last.x(); ++x)
    {
      const Eigen::Vector2d place = voxels.centreOf({x, y, 0}).head<2>();
      const double distance = (place - centre).norm();
      if (distance < radius) visit(x, y, place, distance);
    }
}

void addCrown(const Stem& stem, const TreeOptions& trees, const Density& density, FoliageVoxels& voxels)
{
  const int first = voxels.voxelAt(stem.foot + trees.crown_base * stem.length * stem.axis).z();
  const int last = voxels.voxelAt(stem.foot + stem.length * stem.axis).z();
  for (int z = first; z <= last; ++z)
  {
    // Stems lean so little that a horizontal cut through the crown is a circle.
    const double along = (voxels.centreOf({0, 0, z}).z() - stem.foot.z()) / stem.axis.z();
    const double radius = stem.length * crownRadius(trees, stem.species, along / stem.length);
    forEachColumn(voxels, (stem.foot + along * stem.axis).head<2>(), radius,
                  [&](int x, int y, const Eigen::Vector2d&, double) {
                    voxels.add({x, y, z}, Surface::Crown, density.of({x, y, z}));
                  });
  }
}

/** Dome-shaped patches at random places. Together they cover undergrowth_cover of the ground. */
class Undergrowth
{
 public:
  Undergrowth(const FoliageOptions& options, const Ground& ground, const Lane& lane, std::uint64_t seed)
    : options_(options),
      ground_(ground),
      lane_(lane),
      seed_(seed),
      density_(kProjection * options.undergrowth_leaf_area_density, kGaps, seed)
  {
  }

  void addTile(const GridCell& tile, double tile_size, FoliageVoxels& voxels) const
  {
    // n discs of area A per square metre leave exp(-n A) of the ground free.
    const double area = M_PI_4 * kUndergrowthPatch * kUndergrowthPatch;
    const double patches = -std::log1p(-options_.undergrowth_cover) / area * tile_size * tile_size;
    Random random(seed_, RandomStream::Undergrowth, tile.key());
    for (int left = random.poisson(patches); left > 0; --left)
    {
      const double x = random.uniform(), y = random.uniform();
      const double height = options_.undergrowth_height * random.uniform(0.5, 1.5);
      addPatch(tile_size * Eigen::Vector2d(tile.x + x, tile.y + y), height, voxels);
    }
  }

 private:
  void addPatch(const Eigen::Vector2d& centre, double height, FoliageVoxels& voxels) const
  {
    const double radius = 0.5 * kUndergrowthPatch;
    forEachColumn(voxels, centre, radius,
                  [&](int x, int y, const Eigen::Vector2d& place, double distance)
                  {
                    if (lane_.passes(place, kUndergrowthLane)) return;
                    const double soil = ground_.height(place.x(), place.y());
                    const double top = soil + height * std::sqrt(1 - std::pow(distance / radius, 2));
                    const int last = voxels.voxelAt({0, 0, top}).z();
                    for (int z = voxels.voxelAt({0, 0, soil}).z(); z <= last; ++z)
                      voxels.add({x, y, z}, Surface::Undergrowth, density_.of({x, y, z}));
                  });
  }

  FoliageOptions options_;
  const Ground& ground_;
  const Lane& lane_;
  std::uint64_t seed_;
  Density density_;
};
}  // namespace

FoliageVoxels growFoliage(const FoliageOptions& options, const TreeOptions& trees, const std::vector<Stem>& stems,
                          const Ground& ground, const Lane& lane, double reach, std::uint64_t seed)
{
  double lowest = 0, highest = 0;
  for (const Stem& stem : stems)
  {
    lowest = std::min(lowest, stem.foot.z());
    highest = std::max(highest, stem.foot.z() + stem.length);
  }
  lowest = std::min(lowest, -ground.highest());
  highest = std::max(highest, ground.highest() + 1.5 * options.undergrowth_height);
  FoliageVoxels voxels(kVoxel, lane.cellsWithin(reach, FoliageVoxels::kTile * kVoxel), lowest, highest);
  const Density of_crowns(kProjection * options.leaf_area_density, kGaps, seed);
  for (const Stem& stem : stems) addCrown(stem, trees, of_crowns, voxels);

  constexpr double kTileSize = 8;  // m
  const Undergrowth undergrowth(options, ground, lane, seed);
  for (const GridCell& tile : lane.cellsWithin(reach, kTileSize)) undergrowth.addTile(tile, kTileSize, voxels);
  return voxels;
}
}  // namespace scanloom
