#pragma once
#include "core/ImuSample.h"

#include <deque>
#include <vector>

namespace scanloom
{
/** The IMU's samples in time order, kept until they are forgotten. */
class ImuBuffer
{
 public:
  /** False, and nothing stored, if the stamp is not after the newest one or a value is not finite. */
  bool add(const ImuSample&);

  /** A sample at or before `from` and one at or after `to` are there: between() needs no extrapolation. */
  bool covers(Timestamp from, Timestamp to) const;

  /** Within [from, to] no instant lies in a gap between samples that is longer than `widest`; nor do the ends. */
  bool coversDensely(Timestamp from, Timestamp to, Duration widest) const;

  /**
   * First sample at exactly `from`, last at exactly `to` (both interpolated linearly), all measured ones in between.
   * Where coverage ends early the nearest sample is held. Empty if the buffer is empty or to <= from.
   */
  std::vector<ImuSample> between(Timestamp from, Timestamp to) const;

  /** Drops what between(from, ...) can no longer need. */
  void forgetBefore(Timestamp from);

  bool empty() const { return samples_.empty(); }
  const std::deque<ImuSample>& samples() const { return samples_; }

 private:
  std::deque<ImuSample> samples_;
};
}  // namespace scanloom
