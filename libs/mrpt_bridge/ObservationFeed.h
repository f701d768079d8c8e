#pragma once
#include <mrpt/obs/CObservation.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace scanloom
{
/**
 * Reads ahead in a thread of its own, a bounded number of observations before whoever takes them. For input that can
 * wait: when the queue is full, the reading rests and nothing is dropped.
 */
class ObservationFeed
{
 public:
  /** Called in the feed's thread; null at the end of input. What it throws comes out of take(). */
  using Source = std::function<mrpt::obs::CObservation::Ptr()>;

  ObservationFeed(Source, std::size_t capacity);
  ~ObservationFeed();
  ObservationFeed(const ObservationFeed&) = delete;
  ObservationFeed& operator=(const ObservationFeed&) = delete;

  /** Never waits; null if nothing is ready. Once everything before it is taken, throws what the source threw. */
  mrpt::obs::CObservation::Ptr take();

  /** Whether input has ended and everything is taken. */
  bool ended() const;

 private:
  void read();

  Source source_;
  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable taken_;
  std::deque<mrpt::obs::CObservation::Ptr> queue_;
  std::exception_ptr error_;
  bool source_ended_ = false;
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
