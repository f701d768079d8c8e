#pragma once
#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

namespace scanloom
{
/**
 * The observations that an application was given and still holds. rawlog-grabber tells nobody what it has written, and
 * it writes only half of what waits per period; but what it has written it frees, and that can be seen from here.
 */
class HandedOver
{
 public:
  using Time = std::chrono::steady_clock::time_point;

  /** An application that frees nothing for so long is taken for one that keeps everything. */
  explicit HandedOver(std::chrono::nanoseconds patience) : patience_(patience) {}

  void add(const mrpt::obs::CObservation::Ptr&, Time now);

  /** How many it still holds. */
  std::size_t held(Time now);

  /** Whether it holds some and may yet free them. */
  bool isWorthWaitingFor(Time now) { return held(now) > 0 && now - last_change_ < patience_; }

 private:
  std::chrono::nanoseconds patience_;
  std::vector<std::weak_ptr<mrpt::obs::CObservation>> held_;
  Time last_change_;  // when one was freed, or the first was given
};
}  // namespace scanloom
