#pragma once
#include "input/ros2/Ros2Node.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace scanloom
{
/** Messages that arrived and were not taken yet: the newest, as far as 256 MB go. From any thread. */
class MessageQueue
{
 public:
  /** Received now, by a clock that begins as the computer's and is never set. */
  void push(const Ros2Topic&, Bytes);

  /** The oldest; nothing if none arrives within `patience`. */
  std::optional<Ros2Message> next(Duration patience);

  void clear();

  /** Messages for which there was no memory. */
  std::uint64_t dropped() const;

 private:
  using Steady = std::chrono::steady_clock;

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Ros2Message> queue_;
  std::size_t waiting_ = 0;  // bytes
  std::uint64_t dropped_ = 0;
  Steady::time_point steady_start_ = Steady::now();
  Timestamp started_{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
};
}  // namespace scanloom
