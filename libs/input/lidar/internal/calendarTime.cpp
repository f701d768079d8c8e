#include "input/lidar/internal/calendarTime.h"

namespace scanloom
{
namespace
{
constexpr int kFirstYear = 1970, kLastYear = 2115;

/** Days from 1970-01-01 (Howard Hinnant, chrono-compatible low-level date algorithms); years are positive. */
std::int64_t daysSince1970(int year, int month, int day)
{
  year -= month <= 2 ? 1 : 0;
  const int era = year / 400, of_era = year - era * 400;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097LL + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

bool isWithin(int value, int first, int last) { return value >= first && value <= last; }
}  // namespace

std::optional<Timestamp> timestampOf(const CalendarTime& t)
{
  const bool is_date = isWithin(t.year, kFirstYear, kLastYear) && isWithin(t.month, 1, 12) && isWithin(t.day, 1, 31);
  const bool is_time = isWithin(t.hour, 0, 23) && isWithin(t.minute, 0, 59) && isWithin(t.second, 0, 60);  // leap
  if (!is_date || !is_time) return std::nullopt;
  const std::int64_t days = daysSince1970(t.year, t.month, t.day);
  return Timestamp{std::chrono::seconds{days * 86400 + t.hour * 3600 + t.minute * 60 + t.second}};
}
}  // namespace scanloom
