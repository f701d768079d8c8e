#include "FedInput.h"

#include <utility>

namespace scanloom
{
void FedInput::add(SensorEvent event)
{
  const std::lock_guard lock(mutex_);
  events_.push_back(std::move(event));
  reader_waits_ = false;
  changed_.notify_all();
}

bool FedInput::waitForReader(Duration patience)
{
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [this] { return reader_waits_; });
}

std::optional<SensorEvent> FedInput::next(Duration patience)
{
  std::unique_lock lock(mutex_);
  reader_waits_ = events_.empty();
  changed_.notify_all();
  changed_.wait_for(lock, patience, [this] { return stopped_ || !events_.empty(); });
  if (events_.empty()) return std::nullopt;
  SensorEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

bool FedInput::ended() const
{
  const std::lock_guard lock(mutex_);
  return stopped_ && events_.empty();
}

void FedInput::stop()
{
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}
}  // namespace scanloom
