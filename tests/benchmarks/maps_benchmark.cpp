/** Occupancy of keyframes 4 m apart, two OS0-128 each, against OctoMap's own insertion on one core. */
#include "ForestScans.h"
#include "mrpt/maps/OctoMapExport.h"
#include "mrpt/maps/internal/RayInsertion.h"

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <array>

namespace scanloom
{
namespace
{
struct Rays
{
  octomap::point3d origin;
  octomap::Pointcloud points;  // in the map frame
};

octomap::point3d toOctomap(const Eigen::Vector3d& p)
{
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

std::vector<Rays> keyframesIn(const std::string& stand)
{
  constexpr int kKeyframes = 4;
  const World world = standAround(stand, 60, 1);
  std::vector<Rays> keyframes;
  for (int i = 0; i < kKeyframes; ++i)
    for (const double side : {1.25, -1.25})
    {
      const Rigid body = poseInStand(world, 20 + 4.0 * i, {0.02 * i, 0.01, -0.01});
      const Rigid lidar = body * Rigid::fromXyzYawPitchRoll(0, side, 0, 0, 0.2, 0.3 * side);
      Rays rays{toOctomap(lidar.translation), {}};
      for (const Eigen::Vector3f& p : forestScan(world, lidar, {}, keyframes.size()))
        rays.points.push_back(toOctomap(lidar * p.cast<double>().eval()));
      keyframes.push_back(std::move(rays));
    }
  return keyframes;
}

const std::vector<Rays>& keyframesOf(const benchmark::State& state)
{
  static const std::array<std::vector<Rays>, 2> stands{keyframesIn("sparse"), keyframesIn("dense")};
  return stands.at(static_cast<std::size_t>(state.range(0)));
}

OctoMapOptions presetOf(const benchmark::State& state)
{
  constexpr std::array kPresets{"preview", "inventory", "fine"};
  return octoMapPreset(kPresets.at(static_cast<std::size_t>(state.range(1))));
}

template <typename Insert>
void insertAll(benchmark::State& state, const Insert& insert)
{
  const std::vector<Rays>& keyframes = keyframesOf(state);
  const OctoMapOptions preset = presetOf(state);
  std::size_t nodes = 0;
  for ([[maybe_unused]] auto step : state)
  {
    octomap::OcTree tree(preset.resolution);
    for (const Rays& rays : keyframes) insert(tree, rays, preset.max_range);
    tree.updateInnerOccupancy();
    state.PauseTiming();
    nodes = tree.size();
    tree.clear();
    state.ResumeTiming();
  }
  state.counters["nodes"] = static_cast<double>(nodes);
}

void ours(benchmark::State& state)
{
  insertAll(state, [](octomap::OcTree& tree, const Rays& rays, double max_range)
            { insertRays(tree, rays.points, rays.origin, max_range); });
}

/** The same tree. */
void insertPointCloudDiscretized(benchmark::State& state)
{
  insertAll(state, [](octomap::OcTree& tree, const Rays& rays, double max_range)
            { tree.insertPointCloud(rays.points, rays.origin, max_range, true, true); });
}

/** As it is called by default: every point's ray, inner nodes and pruning at every update. */
void insertPointCloud(benchmark::State& state)
{
  insertAll(state, [](octomap::OcTree& tree, const Rays& rays, double max_range)
            { tree.insertPointCloud(rays.points, rays.origin, max_range); });
}

void standsAndPresets(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({"dense", "preset"})->ArgsProduct({{0, 1}, {0, 1, 2}})->Unit(benchmark::kMillisecond);
  benchmark->Iterations(1)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(ours)->Apply(standsAndPresets);
BENCHMARK(insertPointCloudDiscretized)->Apply(standsAndPresets);
BENCHMARK(insertPointCloud)->Apply(standsAndPresets);
}  // namespace
}  // namespace scanloom
