// What pages cost a run: the time for a scan of localisation without a page (-1), and with 0, 1 and 4 that look at it
// (PageReaders). --benchmark_enable_random_interleaving=true --benchmark_repetitions=5 compares them on a busy machine.
#include "estimation/slam/GentleMachine.h"
#include "estimation/slam/LidarInertialSlam.h"
#include "estimation/slam/StandOfStems.h"
#include "run/page/internal/LiveFeed.h"

#include <benchmark/benchmark.h>

#include "PageReaders.h"

namespace scanloom
{
namespace
{
constexpr Duration kPeriod = 100ms;

RecordingHeader oneLidar()
{
  RecordingHeader header;
  header.lidars.resize(1);
  header.lidars[0].name = "left";
  return header;
}

/** A server, its feed and those who look at it. */
struct Shown
{
  explicit Shown(int pages) : readers(pages, server.address()) {}

  LiveExchange exchange;
  LiveFeed feed{exchange, {"slam", true, true}};
  LiveServer server{{SensorAddress::parse("127.0.0.1").ip, 0}, exchange};
  bench::PageReaders readers;
};

void scanOfSlam(benchmark::State& state)
{
  const auto shown = state.range(0) >= 0 ? std::make_unique<Shown>(static_cast<int>(state.range(0))) : nullptr;
  const RecordingHeader header = oneLidar();
  LidarInertialSlam slam(withMachineBox(), kBodyTImu, {{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}});
  const Machine machine = gentleMachine(3s);
  const StandOfStems stand;
  Timestamp start{100ms}, imu{};
  double scans = 0;
  for (auto _ : state)
  {
    state.PauseTiming();
    for (; imu <= start + kPeriod + 5ms; imu += 5ms) slam.addImu(machine.sampleAt(imu));
    Scan scan = stand.scanAt(start, [&](Timestamp t) { return machine.bodyAt(t); });
    start += kPeriod;
    state.ResumeTiming();
    if (shown) shown->feed.add(scan, header);
    const std::vector<StateEstimate> estimates = slam.addScan(std::move(scan));
    for (const StateEstimate& estimate : estimates)
      if (shown) shown->feed.add(estimate);
    if (shown) shown->feed.update({}, {}), shown->feed.offer();
    ++scans;
  }
  state.counters["real_time_factor"] = benchmark::Counter(scans * seconds(kPeriod), benchmark::Counter::kIsRate);
  if (shown) state.counters["Mbit/s"] = 1e-6 * shown->readers.stop();
}
}  // namespace

BENCHMARK(scanOfSlam)
    ->ArgName("pages")
    ->Arg(-1)
    ->Arg(0)
    ->Arg(1)
    ->Arg(4)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(150);
}  // namespace scanloom
