/** What a capture holds, as `scanloom info` prints it. */
#pragma once
#include "input/packets/internal/CaptureInfo.h"

#include <string>

namespace scanloom
{
std::string toJson(const CaptureInfo&);
std::string toText(const CaptureInfo&);
}  // namespace scanloom
