#pragma once
#include "base/core/BoundedQueue.h"

#include <mrpt/obs/obs_frwds.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <thread>

namespace scanloom
{
/**
 * Reads a source in a thread of its own, a bounded number of observations ahead of take(). Reading pauses while so many
 * wait; nothing is dropped.
 */
class ObservationFeed
{
 public:
  using Observation = std::shared_ptr<mrpt::obs::CObservation>;

  /** Called in the feed's thread; null at the end of input. What it throws comes out of take(). */
  using Source = std::function<Observation()>;

  ObservationFeed(Source, std::size_t capacity);
  ~ObservationFeed();
  ObservationFeed(const ObservationFeed&) = delete;
  ObservationFeed& operator=(const ObservationFeed&) = delete;

  /** Never waits; null if nothing is ready. Once everything before it is taken, throws what the source threw. */
  Observation take() { return queue_.pop(Duration{0}).value_or(nullptr); }

  /** Whether the source has ended and everything was taken. */
  bool ended() const { return queue_.ended(); }

 private:
  void read();

  Source source_;
  BoundedQueue<Observation> queue_;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
