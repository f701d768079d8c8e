/** IMU samples that come twice, or that are stamped as they arrive. */
#pragma once
#include "base/core/ImuSample.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Samples of which each stamp has one, the first. */
struct ImuOfEachStamp
{
  std::vector<ImuSample> samples;
  std::size_t copies = 0;      // that were left out: the same stamp and values
  std::size_t conflicts = 0;   // that were left out: the same stamp, other values
  std::size_t unreadable = 0;  // messages of a bag that cannot be read

  /** What was left out; nothing if all are there. */
  std::optional<std::string> leftOut() const;

  /**
   * The stamps are not of the samples' times: more than one in a hundred has the stamp of another. Drivers that stamp
   * what has waited in a buffer write so.
   */
  bool isStampedInBursts() const { return 100 * conflicts > samples.size() + conflicts; }
};

/** `samples`: in order of stamps. */
ImuOfEachStamp oneOfEachStamp(const std::vector<ImuSample>& samples);
}  // namespace scanloom
