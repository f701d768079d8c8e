#pragma once
#include <string>

namespace scanloom
{
/**
 * The message in the text of an exception, its first line only. MRPT's exceptions put "Message:" before it, a rule of
 * '=' above it, and a call stack behind it.
 */
std::string messageIn(const std::string& what);
}  // namespace scanloom
