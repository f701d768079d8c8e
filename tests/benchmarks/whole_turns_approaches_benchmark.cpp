/**
 * Batching by time beside the paper's approach A (section 1.1): two lidars of 10 Hz amid panels that move away at 10
 * km/h. The counters are what counts, on a virtual clock; the times are those of the whole drive.
 *
 *   <approach>/<mounting>/<phase in ms>   approach: time, nearest, one_of_each; mounting: in_step, alike
 */
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "support/MovingPanels.h"

using namespace scanloom;
using namespace scanloom::panels;

namespace
{
enum class Approach
{
  Time,
  Nearest,
  OneOfEach,
};

std::vector<Scan> scansOf(Approach approach, const Mounting& mounting)
{
  if (approach == Approach::Time) return scansByTime(mounting);
  return scansOfTurns(approach == Approach::Nearest ? TurnGrouping::Nearest : TurnGrouping::OneOfEach, mounting);
}

void drive(benchmark::State& state, Approach approach, const Mounting& mounting)
{
  Figures figures;
  for (auto _ : state) figures = figuresOf(scansOf(approach, mounting));
  state.counters["span_ms"] = 1e3 * seconds(figures.longest_span);
  state.counters["held_ms"] = 1e3 * seconds(figures.longest_held);
  state.counters["smear_mean_cm"] = 1e2 * figures.meanSmear();
  state.counters["smear_p50_cm"] = 1e2 * figures.smear(0.5);
  state.counters["smear_p90_cm"] = 1e2 * figures.smear(0.9);
  state.counters["smear_max_cm"] = 1e2 * figures.smear(1);
  state.counters["doubled_share"] = figures.shareAbove(kDoubled);
  state.counters["sightings"] = static_cast<double>(figures.smears.size());
}

const bool kRegistered = []
{
  const std::pair<const char*, Approach> approaches[] = {
      {"time", Approach::Time}, {"nearest", Approach::Nearest}, {"one_of_each", Approach::OneOfEach}};
  const std::pair<const char*, Mounting (*)(Duration)> mountings[] = {{"in_step", inStep}, {"alike", alike}};
  for (const auto& [approach, value] : approaches)
    for (const auto& [name, mounting] : mountings)
      for (Duration phase = 0ms; phase < kTurn; phase += 10ms)
        benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", approach, name, phase / 1ms).c_str(), drive, value,
                                     mounting(phase))
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
  return true;
}();
}  // namespace
