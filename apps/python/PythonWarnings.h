/** Messages of the libraries as warnings of Python. */
#pragma once
#include <string>
#include <vector>

namespace scanloom
{
/** Each by warnings.warn(), as scanloom.ScanloomWarning. Throws what a filter makes of them. The GIL must be held. */
void warnInPython(const std::vector<std::string>&);

/** Throws KeyboardInterrupt after Ctrl-C, and what other handlers of signals raise. The GIL must be held. */
void throwIfSignalled();
}  // namespace scanloom
