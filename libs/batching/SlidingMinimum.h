#pragma once
#include "core/Time.h"

#include <deque>
#include <optional>

namespace scanloom
{
/** The smallest of the durations seen within the last `span`; the newest one counts however old it is. */
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

  /** When the newest value came; the values must not be empty. */
  Timestamp newest() const { return rising_.back().when; }
  bool empty() const { return rising_.empty(); }

  /** As if every value had been larger by this. */
  void shift(Duration);
  void clear() { rising_.clear(); }

 private:
  struct Seen
  {
    Timestamp when;
    Duration value;
  };

  Duration span_;
  std::deque<Seen> rising_;  // each the smallest of itself and all later ones
};
}  // namespace scanloom
