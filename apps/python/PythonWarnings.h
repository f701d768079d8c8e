/** Messages of the libraries as warnings of Python. */
#pragma once
#include <string>
#include <vector>

namespace scanloom
{
/** Whose line of Python a warning names. */
enum class WarnedLine
{
  Calling = 1,          // the one that calls C++
  CallingScanloom = 2,  // the one that calls a function of scanloom/__init__.py
};

/** Each by warnings.warn(), as scanloom.ScanloomWarning. Throws what a filter makes of them. The GIL must be held. */
void warnInPython(const std::vector<std::string>&, WarnedLine);

/** Throws KeyboardInterrupt after Ctrl-C, and what other handlers of signals raise. The GIL must be held. */
void throwIfSignalled();
}  // namespace scanloom
