#include "estimation/graph/SimulatedDrive.h"

#include <benchmark/benchmark.h>

using namespace scanloom;

namespace
{
enum Covariance
{
  kNone,
  kOfAll,        // of the newest state
  kOfBody,       // of its body before the lidar pose, as localisation asks
  kOfBodyAfter,  // and from that after it
  kOfBodyTwice,  // computed anew instead
};

/** One scan: a state, a lidar pose, the solution; and the covariance where asked for. */
void addScan(benchmark::State& state)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(AnalyticDrive{}, 300, 100ms, noise, 1);
  SmootherOptions options;
  options.window = static_cast<int>(state.range(0));
  const auto covariance = static_cast<Covariance>(state.range(1));
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
    smoother->addState(drive.motions[scan - 1]);
    const Matrix6d before = covariance >= kOfBody ? smoother->newestBodyCovariance() : Matrix6d(Matrix6d::Zero());
    smoother->addPosePrior(drive.map_T_body[scan], drive.information);
    ++scan;
    benchmark::DoNotOptimize(smoother->optimise());
    if (covariance == kOfAll) benchmark::DoNotOptimize(smoother->newestCovariance());
    if (covariance == kOfBodyAfter) benchmark::DoNotOptimize(smoother->bodyCovarianceAfter(before));
    if (covariance == kOfBodyTwice) benchmark::DoNotOptimize(smoother->newestBodyCovariance());
    iterations += smoother->report().iterations;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
}  // namespace

BENCHMARK(addScan)
    ->ArgNames({"window", "covariance"})
    ->Args({5, kNone})
    ->Args({8, kNone})
    ->Args({8, kOfAll})
    ->Args({8, kOfBody})
    ->Args({8, kOfBodyAfter})
    ->Args({8, kOfBodyTwice})
    ->Args({10, kNone})
    ->Unit(benchmark::kMicrosecond);
