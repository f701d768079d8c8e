#include "source/EventQueue.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
EventQueue::EventQueue(const Limits& limits)
{
  kinds_[SensorEvent(Scan{}).index()].limit = limits.scans;
  kinds_[SensorEvent(ScanPart{}).index()].limit = limits.scan_parts;
  kinds_[SensorEvent(SensorImu{}).index()].limit = limits.imu_samples;
}

void EventQueue::push(Waiting event)
{
  {
    const std::lock_guard lock(mutex_);
    Kind& kind = kinds_[event.event.index()];
    ++kind.waiting;
    events_.push_back(std::move(event));
    if (kind.waiting > kind.limit) dropOldest(events_.back().event.index());
  }
  changed_.notify_one();
}

void EventQueue::dropOldest(std::size_t kind)
{
  events_.erase(
      std::find_if(events_.begin(), events_.end(), [kind](const auto& e) { return e.event.index() == kind; }));
  --kinds_[kind].waiting;
  ++kinds_[kind].dropped;
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
  std::optional<Waiting> event(std::move(events_.front()));
  events_.pop_front();
  --kinds_[event->event.index()].waiting;
  return event;
}

bool EventQueue::ended() const
{
  const std::lock_guard lock(mutex_);
  return ended_ && events_.empty() && !error_;
}
}  // namespace scanloom
