#pragma once
#include "base/core/ImuSample.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Refuses the samples of a gyroscope or an accelerometer that hangs: one whose reading stays the same, to the bit on
 * all three axes, for kImuSilence. Noise moves the last bit of one that works many times in that time, also at rest.
 */
class FrozenReadings
{
 public:
  /** In time order. The samples that are known to be readings by now, oldest first: a repeated one waits. */
  std::vector<ImuSample> pass(const ImuSample&);

  std::uint64_t refused() const { return refused_; }

 private:
  std::optional<ImuSample> gyro_since_, accel_since_;  // the first samples with the present readings
  std::vector<ImuSample> waiting_;                     // repeated ones
  std::uint64_t refused_ = 0;
};
}  // namespace scanloom
