/** Seconds with nine decimals, as TUM files and the total station's csv carry them, without the detour over a double.
 */
#pragma once
#include "core/Time.h"

#include <optional>
#include <string>

namespace scanloom
{
/** "1750000000.000000030": 1.75e9 s do not fit into a double to the nanosecond. */
std::string secondsText(Timestamp);

/** Stamps in files lie no farther than this from 1970 (until 2112): 64 bits of ns hold the difference of any two. */
constexpr Duration kFarthestStamp{4'500'000'000'000'000'000};

/**
 * The inverse: exact for nine decimals, further ones are cut. "1.75e9" is read, too, with the precision of a long
 * double. Nothing if `text` is no number, or one beyond kFarthestStamp.
 */
std::optional<Timestamp> parseSeconds(const std::string& text);
}  // namespace scanloom
