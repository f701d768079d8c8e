#include "mrpt_bridge/ObservationFeed.h"

#include <utility>

namespace scanloom
{
ObservationFeed::ObservationFeed(Source source, std::size_t capacity)
  : source_(std::move(source)), capacity_(capacity), thread_([this] { read(); })
{
}

ObservationFeed::~ObservationFeed()
{
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  taken_.notify_all();
  thread_.join();
}

void ObservationFeed::read()
{
  try
  {
    while (auto observation = source_())
    {
      std::unique_lock lock(mutex_);
      taken_.wait(lock, [this] { return stop_ || queue_.size() < capacity_; });
      if (stop_) return;
      queue_.push_back(std::move(observation));
    }
  }
  catch (...)
  {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  source_ended_ = true;
}

mrpt::obs::CObservation::Ptr ObservationFeed::take()
{
  const std::lock_guard lock(mutex_);
  if (queue_.empty())
  {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return nullptr;
  }
  auto observation = std::move(queue_.front());
  queue_.pop_front();
  taken_.notify_all();
  return observation;
}

bool ObservationFeed::ended() const
{
  const std::lock_guard lock(mutex_);
  return source_ended_ && queue_.empty() && !error_;
}
}  // namespace scanloom
