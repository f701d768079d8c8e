#pragma once
#include "source/RigInput.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>

namespace scanloom
{
/** Events on their way from the thread that makes them to the one that uses them. When it is full, the oldest go. */
class EventQueue
{
 public:
  struct Waiting
  {
    SensorEvent event;
    Timestamp newest;  // when the newest datagram was received that it was made of
  };

  struct Limits
  {
    std::size_t scans = 10;
    std::size_t imu_samples = 100'000;
  };

  explicit EventQueue(const Limits& limits) : limits_(limits) {}

  void push(Waiting);

  /** No more will be pushed; what `error` holds is thrown by pop() after all else. */
  void end(std::exception_ptr error = nullptr);

  /** Nothing if nothing came within `patience`, or at the end. */
  std::optional<Waiting> pop(Duration patience);

  /** The end, and all is taken. */
  bool ended() const;

  std::size_t scans() const;
  std::uint64_t droppedScans() const;
  std::uint64_t droppedImuSamples() const;

 private:
  void dropOldest(bool scan);

  Limits limits_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> events_;
  std::size_t scans_ = 0;
  std::uint64_t dropped_scans_ = 0, dropped_imu_samples_ = 0;
  bool ended_ = false;
  std::exception_ptr error_;
};
}  // namespace scanloom
