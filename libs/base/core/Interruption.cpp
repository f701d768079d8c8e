#include "base/core/Interruption.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace scanloom
{
namespace
{
volatile std::sig_atomic_t g_interrupted = 0;  // all that a signal handler may touch

void noteSignal(int) { g_interrupted = 1; }

void noteSignalAndSaySo(int)
{
  g_interrupted = 1;
  // A closing run may take seconds in which a person would press again, and that ends it at once.
  constexpr char kSaid[] = "\nending; once more ends it at once\n";
  if (::write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) return;  // there is nobody to tell
}

void catchSignal(int signal, void (*note)(int))
{
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}
}  // namespace

void catchInterruption()
{
  for (const int signal : {SIGINT, SIGTERM}) catchSignal(signal, &noteSignalAndSaySo);
}

void catchUnhandledInterruption()
{
  g_interrupted = 0;
  for (const int signal : {SIGINT, SIGTERM})
  {
    struct sigaction current = {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler == SIG_DFL) catchSignal(signal, &noteSignal);
  }
}

bool interrupted() { return g_interrupted != 0; }

void throwIfInterrupted()
{
  if (interrupted()) throw Interrupted();
}
}  // namespace scanloom
