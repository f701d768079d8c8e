/** libscanloom_program.so: what main.cpp calls. */
#include "Program.h"

#include <malloc.h>

namespace
{
/**
 * Every scan needs the same tens of MB again. If they are returned to the kernel in between, each of their pages causes
 * a fault again, which took a third of the time of `slam` (doc/performance.md). In one arena, since each thread's own
 * keeps what others could use.
 */
void keepFreedMemory()
{
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}
}  // namespace

extern "C" int runScanloom(int argc, char** argv)
{
  keepFreedMemory();
  return scanloom::runProgram(argc, argv);
}
