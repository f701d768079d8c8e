#pragma once
#include <cstdio>
#include <cstdlib>

namespace scanloom
{
/** A fuzz target's assertion: a broken one ends the run with the input that broke it. */
inline void require(bool holds, int line = __builtin_LINE())
{
  if (holds) return;
  std::fprintf(stderr, "the assertion of line %d is broken\n", line);
  std::abort();
}

/** Any other exception ends the run as a finding. */
template <typename Exception, typename Action>
void mayThrow(const Action& action)
{
  try
  {
    action();
  }
  catch (const Exception&)
  {
  }
}
}  // namespace scanloom
