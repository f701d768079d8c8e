#pragma once
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace scanloom
{
/** Throws std::runtime_error with the remedy if there is none. */
inline void requireDisplay(const char* remedy)
{
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
    throw std::runtime_error(fmt::format("there is no display for a window: {}", remedy));
}
}  // namespace scanloom
