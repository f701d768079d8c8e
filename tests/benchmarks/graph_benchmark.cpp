#include "graph/SimulatedDrive.h"

#include <benchmark/benchmark.h>

using namespace scanloom;

namespace
{
/** One scan: a state, a lidar pose, the solution; and the covariance where asked for. */
void addScan(benchmark::State& state)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(AnalyticDrive{}, 300, 100ms, noise, 1);
  SmootherOptions options;
  options.window = static_cast<int>(state.range(0));
  std::size_t scan = drive.truth.size();
  std::optional<FixedLagSmoother> smoother;
  double iterations = 0;
  for (auto _ : state)
  {
    if (scan == drive.truth.size())
    {
      state.PauseTiming();
      smoother.emplace(smootherFor(drive, noise, options));
      for (scan = 1; scan < 10; ++scan) feed(*smoother, drive, scan);
      state.ResumeTiming();
    }
    feed(*smoother, drive, scan++);
    benchmark::DoNotOptimize(smoother->optimise());
    if (state.range(1)) benchmark::DoNotOptimize(smoother->newestCovariance());
    iterations += smoother->report().iterations;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
}  // namespace

BENCHMARK(addScan)
    ->ArgNames({"window", "covariance"})
    ->Args({5, 0})
    ->Args({8, 0})
    ->Args({8, 1})
    ->Args({10, 0})
    ->Unit(benchmark::kMicrosecond);
