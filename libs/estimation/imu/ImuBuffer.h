#pragma once
#include "base/core/ImuSample.h"

#include <deque>
#include <vector>

namespace scanloom
{
/** An IMU without a reading for so long is silent. */
inline constexpr Duration kImuSilence = 200ms;

/** The IMU's samples in time order, until forgetBefore() removes them. */
class ImuBuffer
{
 public:
  ImuBuffer() = default;

  /** Of the samples that add() does not refuse. */
  explicit ImuBuffer(const std::vector<ImuSample>&);

  /** False, and nothing stored, if the stamp is not after the newest one or a value is not finite. */
  bool add(const ImuSample&);

  /** A sample at or before `from` and one at or after `to` are there: between() needs no extrapolation. */
  bool covers(Timestamp from, Timestamp to) const;

  /** No gap between samples that is longer than `widest` reaches into [from, to]. */
  bool coversDensely(Timestamp from, Timestamp to, Duration widest) const;

  /**
   * The samples between the ends, with one at exactly `from` and one at exactly `to`, both interpolated linearly. Where
   * coverage ends early the nearest sample is held. Empty if the buffer is empty or to <= from.
   */
  std::vector<ImuSample> between(Timestamp from, Timestamp to) const;

  /** Removes the samples that between(from, ...) does not need. */
  void forgetBefore(Timestamp from);

  bool empty() const { return samples_.empty(); }
  const std::deque<ImuSample>& samples() const { return samples_; }

 private:
  std::deque<ImuSample> samples_;
};
}  // namespace scanloom
