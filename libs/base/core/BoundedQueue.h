/** The one queue between two threads: one pushes, the other pops. */
#pragma once
#include "base/core/Time.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * Values in the order in which they were pushed. They may be of several kinds, each with a limit of its own. push()
 * waits where a kind is full (files can wait); pushDroppingOldest() never waits (sensors cannot).
 */
template <typename T>
class BoundedQueue
{
 public:
  /** The index of a value's kind in `limits`. */
  using KindOf = std::function<std::size_t(const T&)>;

  explicit BoundedQueue(std::size_t limit) : BoundedQueue({limit}, [](const T&) { return 0; }) {}

  BoundedQueue(const std::vector<std::size_t>& limits, KindOf kind_of) : kind_of_(std::move(kind_of))
  {
    for (const std::size_t limit : limits) kinds_.push_back({limit, 0, 0});
  }

  /** Returns when there is room for the next value; false if nobody pops any more. */
  bool push(T value)
  {
    std::unique_lock lock(mutex_);
    add(std::move(value));
    changed_.wait(lock, [this] { return closed_ || std::none_of(kinds_.begin(), kinds_.end(), &BoundedQueue::full); });
    return !closed_;
  }

  /** Where the limit of its kind is exceeded, the oldest value of the kind is dropped and counted. */
  void pushDroppingOldest(T value)
  {
    const std::lock_guard lock(mutex_);
    const std::size_t kind = kind_of_(value);
    add(std::move(value));
    if (kinds_[kind].waiting <= kinds_[kind].limit) return;
    values_.erase(
        std::find_if(values_.begin(), values_.end(), [&](const T& other) { return kind_of_(other) == kind; }));
    --kinds_[kind].waiting;
    ++kinds_[kind].dropped;
  }

  /** Nothing more will be pushed. pop() throws `error`, if there is one, once after the last value. */
  void end(std::exception_ptr error = nullptr)
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    error_ = std::move(error);
    changed_.notify_all();
  }

  /** Nothing more will be popped: push() waits no longer. */
  void close()
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  /** Nothing if no value came within `patience`, and nothing at the end. */
  std::optional<T> pop(Duration patience)
  {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return ended_ || !values_.empty(); });
    return takeFirst();
  }

  /** The next value however long it takes; nothing at the end. */
  std::optional<T> pop()
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !values_.empty(); });
    return takeFirst();
  }

  /** The end was reached, every value was popped, and the error was thrown. */
  bool ended() const
  {
    const std::lock_guard lock(mutex_);
    return ended_ && values_.empty() && !error_;
  }

  std::size_t waiting(std::size_t kind = 0) const
  {
    const std::lock_guard lock(mutex_);
    return kinds_.at(kind).waiting;
  }

  std::uint64_t dropped(std::size_t kind = 0) const
  {
    const std::lock_guard lock(mutex_);
    return kinds_.at(kind).dropped;
  }

 private:
  struct Kind
  {
    std::size_t limit, waiting;
    std::uint64_t dropped;
  };

  static bool full(const Kind& kind) { return kind.waiting >= kind.limit; }

  void add(T value)
  {
    ++kinds_[kind_of_(value)].waiting;
    values_.push_back(std::move(value));
    changed_.notify_all();
  }

  std::optional<T> takeFirst()
  {
    if (values_.empty())
    {
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      return std::nullopt;
    }
    std::optional<T> first(std::move(values_.front()));
    values_.pop_front();
    --kinds_[kind_of_(*first)].waiting;
    changed_.notify_all();
    return first;
  }

  KindOf kind_of_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> values_;
  std::vector<Kind> kinds_;
  bool ended_ = false, closed_ = false;
  std::exception_ptr error_;
};
}  // namespace scanloom
