#include "run/page/internal/yieldToAll.h"

#include <pthread.h>
#include <sched.h>

namespace scanloom
{
void yieldToAll()
{
  const sched_param priority{};
  pthread_setschedparam(pthread_self(), SCHED_IDLE, &priority);
}
}  // namespace scanloom
