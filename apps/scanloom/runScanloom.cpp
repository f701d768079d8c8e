/** libscanloom_program.so: what main.cpp calls. */
#include "Program.h"
#include "keepFreedMemory.h"

namespace
{
/** Each thread's own arena keeps what others could use. */
void shareFreedMemory()
{
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
#endif
}
}  // namespace

extern "C" int runScanloom(int argc, char** argv)
{
  shareFreedMemory();
  scanloom::keepFreedMemory();
  return scanloom::runProgram(argc, argv);
}
