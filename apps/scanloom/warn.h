#pragma once
#include "base/core/Text.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace scanloom
{
/** In a line of its own on stderr. */
inline void warn(const std::string& text) { fmt::print(stderr, "warning: {}\n", printableLines(text)); }
}  // namespace scanloom
