#pragma once
#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

namespace scanloom
{
/**
 * The observations that an application was given and still holds. rawlog-grabber writes only half of the waiting
 * observations per period and does not report what it has written. But it frees what it has written, and weak pointers
 * show that.
 */
class HandedOver
{
 public:
  using Time = std::chrono::steady_clock::time_point;

  /** An application that frees nothing for `patience` is assumed to keep everything. */
  explicit HandedOver(std::chrono::nanoseconds patience) : patience_(patience) {}

  void add(const mrpt::obs::CObservation::Ptr&, Time now);

  /** How many it still holds. */
  std::size_t held(Time now);

  /** Whether it holds observations and may still free them. */
  bool isWorthWaitingFor(Time now) { return held(now) > 0 && now - last_change_ < patience_; }

 private:
  std::chrono::nanoseconds patience_;
  std::vector<std::weak_ptr<mrpt::obs::CObservation>> held_;
  Time last_change_;  // when one was freed, or the first was given
};
}  // namespace scanloom
