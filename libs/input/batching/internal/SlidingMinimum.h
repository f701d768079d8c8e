#pragma once
#include "base/core/Time.h"

#include <deque>
#include <optional>

namespace scanloom
{
/** The smallest duration of the last `span` of time. The newest one always counts, whatever its age. */
class SlidingMinimum
{
 public:
  explicit SlidingMinimum(Duration span) : span_(span) {}

  void add(Timestamp when, Duration value);

  /** None before the first value. */
  std::optional<Duration> value() const
  {
    return rising_.empty() ? std::nullopt : std::optional(rising_.front().value);
  }

  /** When the newest value was added; there must be one. */
  Timestamp newest() const { return rising_.back().when; }
  bool empty() const { return rising_.empty(); }

  /** Adds to every value. */
  void shift(Duration);
  void clear() { rising_.clear(); }

 private:
  struct Value
  {
    Timestamp when;
    Duration value;
  };

  Duration span_;
  std::deque<Value> rising_;  // values that are smaller than all later ones
};
}  // namespace scanloom
