#pragma once
#include <malloc.h>

namespace scanloom
{
/**
 * Every scan needs the same tens of MB again. If they are returned to the kernel in between, each of their pages causes
 * a fault again, which took a third of the time of `slam` (doc/performance.md). Of the whole process.
 */
inline void keepFreedMemory()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}
}  // namespace scanloom
