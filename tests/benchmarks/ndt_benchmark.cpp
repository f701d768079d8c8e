/** Binning per point, and a whole registration of two scans the size of two OS0-128. */
#include "ndt/RayWorld.h"
#include "ndt/Registration.h"

#include <benchmark/benchmark.h>

namespace scanloom
{
namespace
{
const Rigid kMotion = Rigid::fromXyzYawPitchRoll(0.2, 0.1, 0.02, 0.02, 0.005, -0.005);

RayLidar twoOs0() { return {256, 1024, 0.78, 60, 0.01}; }

/** Two thirds of the rays meet something: repeated with a new phase until the scan has its 262144 points. */
std::vector<Eigen::Vector3f> fullScan(const Rigid& world_T_lidar, std::uint64_t seed)
{
  constexpr std::size_t kPoints = 262144;
  std::vector<Eigen::Vector3f> points;
  for (; points.size() < kPoints; ++seed)
  {
    const auto more = scanFrom(forest(3), world_T_lidar, seed, twoOs0());
    points.insert(points.end(), more.begin(), more.end());
  }
  points.resize(kPoints);
  return points;
}

const std::vector<Eigen::Vector3f>& targetPoints()
{
  static const auto points = fullScan(Rigid::identity(), 1);
  return points;
}

const std::vector<Eigen::Vector3f>& sourcePoints()
{
  static const auto points = fullScan(kMotion, 11);
  return points;
}

NdtMap mapOf(const std::vector<Eigen::Vector3f>& points, double cell_size)
{
  NdtOptions options;
  options.cell_size = cell_size;
  return NdtMap(points, options);
}

/** Argument: edge of the cells in cm. */
void Binning(benchmark::State& state)
{
  const auto& points = sourcePoints();
  for (auto _ : state) benchmark::DoNotOptimize(mapOf(points, state.range(0) / 100.0));
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(Binning)->Arg(50)->Arg(100)->Arg(250)->Arg(400)->Unit(benchmark::kMillisecond);

void Alignment(benchmark::State& state)
{
  const NdtMap target = mapOf(targetPoints(), 1.0), source = mapOf(sourcePoints(), state.range(0) / 100.0);
  int iterations = 0;
  for (auto _ : state) iterations = align(target, source, Rigid::identity(), {}).iterations;
  state.counters["steps"] = iterations;
}
BENCHMARK(Alignment)->Arg(50)->Arg(100)->Arg(250)->Unit(benchmark::kMillisecond);

void AlignmentWithPreparationOfTheScan(benchmark::State& state)
{
  const NdtMap target = mapOf(targetPoints(), 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(align(target, mapOf(sourcePoints(), 2.5), Rigid::identity(), {}));
}
BENCHMARK(AlignmentWithPreparationOfTheScan)->Unit(benchmark::kMillisecond);

void MergingAKeyframe(benchmark::State& state)
{
  const NdtMap target = mapOf(targetPoints(), 1.0), source = mapOf(sourcePoints(), 1.0);
  NdtMap local = target;
  for (auto _ : state)
  {
    local.add(source);
    local.remove(source);
  }
}
BENCHMARK(MergingAKeyframe)->Unit(benchmark::kMillisecond);
}  // namespace
}  // namespace scanloom
