/** SIGINT (Ctrl-C) and SIGTERM: a verb finishes the step that it is at, saves, and ends with status 130. */
#pragma once

namespace scanloom
{
/** From now on the first SIGINT or SIGTERM only sets interrupted(), and says so at once on stderr; a second one ends
 * the program. */
void catchInterruption();

/** The same in a program of others: a signal that it handles or ignores is left to it. Clears interrupted(). */
void catchUnhandledInterruption();

bool interrupted();
}  // namespace scanloom
