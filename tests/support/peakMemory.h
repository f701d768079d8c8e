#pragma once
#include <sys/resource.h>

namespace scanloom
{
/** The most memory that this process ever had. */
inline long peakMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}
}  // namespace scanloom
