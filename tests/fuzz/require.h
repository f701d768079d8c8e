#pragma once
#include <cstdlib>

namespace scanloom
{
/** A fuzz target's assertion: a broken one ends the run with the input that broke it. */
inline void require(bool holds)
{
  if (!holds) std::abort();
}
}  // namespace scanloom
