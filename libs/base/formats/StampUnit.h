/** In which unit integer stamps count. */
#pragma once
#include "base/core/Time.h"

#include <optional>

namespace scanloom
{
struct StampUnit
{
  const char* name;          // "us"
  std::int64_t nanoseconds;  // of one

  /** None before 1827 and after 2112 (kFarthestStamp). */
  std::optional<Timestamp> stampOf(std::int64_t integer) const;
};

/** s, ms, us or ns: that in which a step of so much is from `shortest` to `longest`, less than a thousand times as
 * long; none if it is in none of them. */
std::optional<StampUnit> unitByPace(double step, Duration shortest, Duration longest);

/** s, ms, us or ns: that in which the stamp is a date from 1980 to 2112; none if it is in none of them. */
std::optional<StampUnit> unitByDate(std::int64_t stamp);
}  // namespace scanloom
