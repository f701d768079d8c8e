#include "MessageQueue.h"

#include <utility>

namespace scanloom
{
void MessageQueue::push(const Ros2Topic& topic, Bytes bytes)
{
  constexpr std::size_t kMemory = 256'000'000;  // bytes: two seconds of eight lidars
  const Timestamp now = started_ + std::chrono::duration_cast<Duration>(Steady::now() - steady_start_);
  const std::lock_guard lock(mutex_);
  queue_.push_back({topic, now, {bytes.begin(), bytes.end()}});
  waiting_ += bytes.size();
  for (; waiting_ > kMemory && queue_.size() > 1; queue_.pop_front())
  {
    waiting_ -= queue_.front().data.size();
    ++dropped_;
  }
  arrived_.notify_one();
}

std::optional<Ros2Message> MessageQueue::next(Duration patience)
{
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, patience, [this] { return !queue_.empty(); });
  if (queue_.empty()) return std::nullopt;
  std::optional<Ros2Message> message(std::move(queue_.front()));
  queue_.pop_front();
  waiting_ -= message->data.size();
  return message;
}

void MessageQueue::clear()
{
  const std::lock_guard lock(mutex_);
  queue_.clear();
  waiting_ = 0;
}

std::uint64_t MessageQueue::dropped() const
{
  const std::lock_guard lock(mutex_);
  return dropped_;
}
}  // namespace scanloom
