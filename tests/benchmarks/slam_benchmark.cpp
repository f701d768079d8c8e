// What a scan costs while a machine is followed, and while it is LOST: the second is to be at most five of the first.
#include "estimation/slam/GentleMachine.h"
#include "estimation/slam/LidarInertialSlam.h"
#include "estimation/slam/StandOfStems.h"

#include <benchmark/benchmark.h>

namespace scanloom
{
namespace
{
/** From 6 s on it may be put down elsewhere, with a gyroscope that is wrong: nothing of what is tried fits. */
class Journey
{
 public:
  explicit Journey(bool lost)
    : lost_(lost), slam_(settings(), kBodyTImu, {{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}})
  {
  }

  Scan nextScan()
  {
    for (; imu_ <= start_ + 105ms; imu_ += 5ms)
    {
      ImuSample sample = machine_.sampleAt(imu_);
      if (isElsewhere(imu_)) sample.gyro.z() += 1.5;
      slam_.addImu(sample);
    }
    const StandOfStems& stand = isElsewhere(start_) ? other_ : stand_;
    Scan scan = stand.scanAt(start_, [&](Timestamp t) { return machine_.bodyAt(t); });
    start_ += 100ms;
    return scan;
  }

  std::vector<StateEstimate> add(Scan scan) { return slam_.addScan(std::move(scan)); }
  Timestamp start() const { return start_; }

 private:
  static SlamSettings settings()
  {
    SlamSettings settings = withMachineBox();
    settings.slam.trust.contradiction = 0;
    settings.slam.trust.restart_after = 1000;
    return settings;
  }
  bool isElsewhere(Timestamp t) const { return lost_ && t >= Timestamp{6s}; }

  bool lost_;
  Machine machine_ = gentleMachine(3s);
  StandOfStems stand_, other_{7};
  LidarInertialSlam slam_;
  Timestamp imu_{0ms}, start_{100ms};
};

void scan(benchmark::State& state, bool lost)
{
  Journey journey(lost);
  while (journey.start() < Timestamp{9500ms}) journey.add(journey.nextScan());
  for (auto _ : state)
  {
    state.PauseTiming();
    Scan next = journey.nextScan();
    state.ResumeTiming();
    const auto estimates = journey.add(std::move(next));
    const Health expected = lost ? Health::Lost : Health::Ok;
    if (estimates.empty() || estimates.back().health != expected)
      state.SkipWithError("not in the state to be measured");
  }
}
BENCHMARK_CAPTURE(scan, followed, false)->Iterations(40)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(scan, lost, true)->Iterations(40)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}  // namespace
}  // namespace scanloom
