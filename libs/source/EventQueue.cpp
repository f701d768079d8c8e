#include "source/EventQueue.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
bool isScan(const EventQueue::Waiting& w) { return std::holds_alternative<Scan>(w.event); }
}  // namespace

void EventQueue::push(Waiting event)
{
  {
    const std::lock_guard lock(mutex_);
    scans_ += isScan(event);
    events_.push_back(std::move(event));
    if (scans_ > limits_.scans) dropOldest(true);
    if (events_.size() - scans_ > limits_.imu_samples) dropOldest(false);
  }
  changed_.notify_one();
}

void EventQueue::dropOldest(bool scan)
{
  events_.erase(std::find_if(events_.begin(), events_.end(), [scan](const auto& e) { return isScan(e) == scan; }));
  scans_ -= scan;
  ++(scan ? dropped_scans_ : dropped_imu_samples_);
}

void EventQueue::end(std::exception_ptr error)
{
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    error_ = std::move(error);
  }
  changed_.notify_one();
}

std::optional<EventQueue::Waiting> EventQueue::pop(Duration patience)
{
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return ended_ || !events_.empty(); });
  if (events_.empty())
  {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return std::nullopt;
  }
  Waiting event = std::move(events_.front());
  events_.pop_front();
  scans_ -= isScan(event);
  return event;
}

bool EventQueue::ended() const
{
  const std::lock_guard lock(mutex_);
  return ended_ && events_.empty() && !error_;
}

std::size_t EventQueue::scans() const
{
  const std::lock_guard lock(mutex_);
  return scans_;
}

std::uint64_t EventQueue::droppedScans() const
{
  const std::lock_guard lock(mutex_);
  return dropped_scans_;
}

std::uint64_t EventQueue::droppedImuSamples() const
{
  const std::lock_guard lock(mutex_);
  return dropped_imu_samples_;
}
}  // namespace scanloom
