#pragma once
#include "base/core/Time.h"

#include <cmath>

namespace scanloom
{
/** A clock that counts modulo `modulus` shows `stamp`: the time nearest to `expected`. A modulus of 0 does not wrap. */
inline Timestamp unwrapped(Timestamp stamp, Duration modulus, Timestamp expected)
{
  if (modulus == Duration{0}) return stamp;
  return stamp + std::llround(seconds(expected - stamp) / seconds(modulus)) * modulus;
}
}  // namespace scanloom
