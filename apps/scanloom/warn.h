#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace scanloom
{
/** In a line of its own on stderr. */
inline void warn(const std::string& text) { fmt::print(stderr, "warning: {}\n", text); }
}  // namespace scanloom
