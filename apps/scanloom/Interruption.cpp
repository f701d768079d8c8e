#include "Interruption.h"

#include <csignal>

namespace scanloom
{
namespace
{
volatile std::sig_atomic_t g_interrupted = 0;  // all that a signal handler may touch
}

void catchInterruption()
{
  struct sigaction action = {};
  action.sa_handler = [](int) { g_interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return g_interrupted != 0; }
}  // namespace scanloom
