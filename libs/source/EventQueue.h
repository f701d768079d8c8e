#pragma once
#include "source/RigInput.h"

#include <array>
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
    std::size_t scan_parts = 10;
    std::size_t imu_samples = 100'000;
  };

  explicit EventQueue(const Limits&);

  void push(Waiting);

  /** No more will be pushed; what `error` holds is thrown by pop() after all else. */
  void end(std::exception_ptr error = nullptr);

  /** Nothing if nothing came within `patience`, or at the end. */
  std::optional<Waiting> pop(Duration patience);

  /** The end, and all is taken. */
  bool ended() const;

  std::size_t scans() const { return kind<Scan>().waiting; }
  std::uint64_t droppedScans() const { return kind<Scan>().dropped; }
  std::uint64_t droppedScanParts() const { return kind<ScanPart>().dropped; }
  std::uint64_t droppedImuSamples() const { return kind<SensorImu>().dropped; }

 private:
  struct Kind
  {
    std::size_t limit = 0, waiting = 0;
    std::uint64_t dropped = 0;
  };

  template <typename Event>
  Kind kind() const
  {
    const std::lock_guard lock(mutex_);
    return kinds_[SensorEvent(Event{}).index()];
  }
  void dropOldest(std::size_t kind);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> events_;
  std::array<Kind, std::variant_size_v<SensorEvent>> kinds_;  // by the index of the variant
  bool ended_ = false;
  std::exception_ptr error_;
};
}  // namespace scanloom
