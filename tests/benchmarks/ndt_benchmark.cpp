/** Binning per point, and a whole registration of two scans the size of two OS0-128. */
#include "benchmarks/FullScan.h"
#include "estimation/ndt/Registration.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace scanloom
{
namespace
{
const std::vector<Eigen::Vector3f>& targetPoints()
{
  static const auto points = fullScan(Rigid::identity(), 1);
  return points;
}

const std::vector<Eigen::Vector3f>& sourcePoints()
{
  static const auto points = fullScan(fullScanMotion(), 11);
  return points;
}

NdtMap mapOf(const std::vector<Eigen::Vector3f>& points, double cell_size)
{
  NdtOptions options;
  options.cell_size = cell_size;
  return NdtMap(points, options);
}

/** As many as the last argument says. */
class Threads
{
 public:
  explicit Threads(benchmark::State& state, int argument)
    : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(argument)))
  {
  }

 private:
  tbb::global_control limit_;
};

/** Arguments: edge of the cells in cm, threads. */
void Binning(benchmark::State& state)
{
  const Threads threads(state, 1);
  const auto& points = sourcePoints();
  for (auto _ : state) benchmark::DoNotOptimize(mapOf(points, state.range(0) / 100.0));
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(Binning)->ArgsProduct({{50, 100, 250, 400}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

/** From 1 m: to 2 and to 4 m. */
void CoarserLevels(benchmark::State& state)
{
  const NdtMap fine = mapOf(sourcePoints(), 1.0);
  for (auto _ : state)
  {
    const NdtMap two = fine.coarser(2);
    benchmark::DoNotOptimize(two.coarser(2));
  }
}
BENCHMARK(CoarserLevels)->Unit(benchmark::kMillisecond);

void Alignment(benchmark::State& state)
{
  const Threads threads(state, 1);
  const NdtMap target = mapOf(targetPoints(), 1.0), source = mapOf(sourcePoints(), state.range(0) / 100.0);
  int iterations = 0;
  for (auto _ : state) iterations = align(target, source, Rigid::identity(), {}).iterations;
  state.counters["steps"] = iterations;
}
BENCHMARK(Alignment)->ArgsProduct({{50, 100, 250}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

void AlignmentWithPreparationOfTheScan(benchmark::State& state)
{
  const Threads threads(state, 0);
  const NdtMap target = mapOf(targetPoints(), 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(align(target, mapOf(sourcePoints(), 2.5), Rigid::identity(), {}));
}
BENCHMARK(AlignmentWithPreparationOfTheScan)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void MergingAKeyframe(benchmark::State& state)
{
  NdtMap local = mapOf(targetPoints(), 1.0);
  const BinnedPoints source = binned({{sourcePoints(), std::nullopt}}, local.options());
  for (auto _ : state)
  {
    local.add(source);
    local.remove(source);
  }
}
BENCHMARK(MergingAKeyframe)->Unit(benchmark::kMillisecond);
}  // namespace
}  // namespace scanloom
