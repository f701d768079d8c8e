/** Stamps as text in seconds with nine decimals, without conversion to double. */
#pragma once
#include "base/core/Time.h"

#include <optional>
#include <string>

namespace scanloom
{
/** "1750000000.000000030"; a double would lose the nanoseconds. */
std::string secondsText(Timestamp);

/** Largest distance of a stamp from 1970 (until 2112): the difference of two stamps fits into 64 bits of ns. */
constexpr Duration kFarthestStamp{4'500'000'000'000'000'000};

/**
 * The inverse of secondsText(); decimals after the ninth are cut. "1.75e9" is read with the precision of a long double.
 * Nothing if `text` is no number, or farther from 0 than kFarthestStamp.
 */
std::optional<Timestamp> parseSeconds(const std::string& text);
}  // namespace scanloom
