#pragma once
#include "base/core/Time.h"

#include <optional>

namespace scanloom
{
/** Of the Gregorian calendar, UTC. */
struct CalendarTime
{
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
};

/** Nothing where there is no such date or time, before 1970, or after 2115: stamps have 62 bits. */
std::optional<Timestamp> timestampOf(const CalendarTime&);
}  // namespace scanloom
