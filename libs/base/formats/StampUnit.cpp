#include "base/formats/StampUnit.h"

#include "base/formats/SecondsText.h"

#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::array kUnits{StampUnit{"s", 1'000'000'000}, StampUnit{"ms", 1'000'000}, StampUnit{"us", 1'000},
                            StampUnit{"ns", 1}};
}  // namespace

std::optional<Timestamp> StampUnit::stampOf(std::int64_t integer) const
{
  const std::int64_t farthest = kFarthestStamp.count() / nanoseconds;
  if (integer < -farthest || integer > farthest) return std::nullopt;
  return fromNanoseconds(integer * nanoseconds);
}

std::optional<StampUnit> unitByPace(double step, Duration shortest, Duration longest)
{
  for (const StampUnit& unit : kUnits)
  {
    const double ns = step * static_cast<double>(unit.nanoseconds);
    if (ns >= static_cast<double>(shortest.count()) && ns <= static_cast<double>(longest.count())) return unit;
  }
  return std::nullopt;
}

std::optional<StampUnit> unitByDate(std::int64_t stamp)
{
  constexpr Duration kYear1980 = 315'532'800s;
  for (const StampUnit& unit : kUnits)
    if (stamp >= kYear1980.count() / unit.nanoseconds && stamp < kFarthestStamp.count() / unit.nanoseconds) return unit;
  return std::nullopt;
}
}  // namespace scanloom
