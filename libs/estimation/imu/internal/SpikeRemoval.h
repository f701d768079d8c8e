#pragma once
#include "base/core/ImuSample.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Refuses what no IMU of a machine reads: values beyond the range of such sensors, and spikes. A spike leaves the
 * reading before it by more than a shock does from one sample to the next, and is back within 50 ms. What stays away
 * for longer is a motion. After refused samples the next one is marked (ImuSample::after_refused).
 */
class SpikeRemoval
{
 public:
  /** Finite and in time order. The samples that are known to be readings by now, oldest first. */
  std::vector<ImuSample> pass(const ImuSample&);

  std::uint64_t beyondRange() const { return beyond_range_; }
  std::uint64_t spikes() const { return spikes_; }

 private:
  /** Between one sample and the next. */
  struct Step
  {
    Timestamp stamp;
    double gyro = 0, accel = 0;  // rad/s, m/s2
  };

  bool isFarFromLast(const ImuSample&) const;
  bool stayedAway(const ImuSample&) const;
  void accept(ImuSample, std::vector<ImuSample>& passed);

  std::optional<ImuSample> last_;   // that passed
  std::deque<Step> steps_;          // of the samples that passed in the last 0.1 s
  std::vector<ImuSample> waiting_;  // far from last_
  bool refused_since_last_ = false;
  std::uint64_t beyond_range_ = 0, spikes_ = 0;
};
}  // namespace scanloom
