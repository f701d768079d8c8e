#pragma once
#include "estimation/imu/internal/FrozenReadings.h"
#include "estimation/imu/internal/SpikeRemoval.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Samples that were refused, by reason. */
struct RefusedReadings
{
  std::uint64_t unusable = 0;  // not finite, or not after the sample before
  std::uint64_t beyond_range = 0, spikes = 0, constant = 0;

  std::uint64_t sum() const { return unusable + beyond_range + spikes + constant; }

  /** "3 beyond its range, 20 constant"; only the reasons that occurred. */
  std::string toString() const;
};

/** What comes from one IMU, without what it cannot have read. */
class ImuScreening
{
 public:
  /** The samples that are known to be readings by now, in time order: mostly the one that is given, at once. */
  std::vector<ImuSample> pass(const ImuSample&);

  RefusedReadings refused() const;

 private:
  std::optional<Timestamp> newest_;
  SpikeRemoval spikes_;
  FrozenReadings frozen_;
  std::uint64_t unusable_ = 0;
};
}  // namespace scanloom
