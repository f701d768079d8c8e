/** SIGINT (Ctrl-C) and SIGTERM: a verb finishes the step that it is at, saves, and ends with status 130. */
#pragma once
#include <exception>

namespace scanloom
{
/** From now on the first SIGINT or SIGTERM only sets interrupted(), and says so at once on stderr; a second one ends
 * the program. */
void catchInterruption();

/** The same in a program of others: a signal that it handles or ignores is left to it. Clears interrupted(). */
void catchUnhandledInterruption();

bool interrupted();

/** Ends work that has nothing to save: thrown by throwIfInterrupted(), caught by the verb. */
struct Interrupted : std::exception
{
  const char* what() const noexcept override { return "interrupted"; }
};

/** For work of many seconds, several times in each. */
void throwIfInterrupted();
}  // namespace scanloom
