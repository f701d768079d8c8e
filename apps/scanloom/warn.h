#pragma once
#include "base/core/Text.h"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>

namespace scanloom
{
/** In a line of its own on stderr. */
inline void warn(const std::string& text) { fmt::print(stderr, "warning: {}\n", printableLines(text)); }

/** The same, unless there is nothing to say. */
inline void warnIfAny(const std::string& text)
{
  if (!text.empty()) warn(text);
}

/** What a person is told beside results: by the program on its terminal, by the Python module as warnings and notes. */
struct Messages
{
  std::function<void(const std::string&)> warn = &scanloom::warn;
  std::function<void(const std::string&)> say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
};
}  // namespace scanloom
