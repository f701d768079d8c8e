/** libscanloom_program.so: the table of all verbs, and what main.cpp calls. */
#include "Program.h"
#include "Verb.h"

#include <malloc.h>

namespace scanloom
{
Verb calibrateVerb();
Verb configVerb();
Verb doctorVerb();
Verb editVerb();
Verb evaluateVerb();
Verb experimentVerb();
Verb infoVerb();
Verb mapVerb();
Verb recordVerb();
Verb registerVerb();
Verb reportVerb();
Verb simulateVerb();
Verb slamVerb();
Verb viewVerb();

const std::vector<Verb>& verbs()
{
  static const std::vector<Verb> table{
      recordVerb(),   infoVerb(),     editVerb(), doctorVerb(), calibrateVerb(), configVerb(),     slamVerb(),
      evaluateVerb(), registerVerb(), mapVerb(),  viewVerb(),   simulateVerb(),  experimentVerb(), reportVerb(),
  };
  return table;
}
}  // namespace scanloom

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
