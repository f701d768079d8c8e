/** What a rawlog holds, as `scanloom info` and `scanloom edit --info` print it. */
#pragma once
#include "mrpt/observations/RawlogInfo.h"

#include <string>

namespace scanloom
{
std::string toJson(const RawlogInfo&);
std::string toText(const RawlogInfo&);
}  // namespace scanloom
