#include "core/Interruption.h"

#include <csignal>
#include <initializer_list>

namespace scanloom
{
namespace
{
volatile std::sig_atomic_t g_interrupted = 0;  // all that a signal handler may touch

void catchSignal(int signal)
{
  struct sigaction action = {};
  action.sa_handler = [](int) { g_interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}
}  // namespace

void catchInterruption()
{
  for (const int signal : {SIGINT, SIGTERM}) catchSignal(signal);
}

void catchUnhandledInterruption()
{
  g_interrupted = 0;
  for (const int signal : {SIGINT, SIGTERM})
  {
    struct sigaction current = {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler == SIG_DFL) catchSignal(signal);
  }
}

bool interrupted() { return g_interrupted != 0; }
}  // namespace scanloom
