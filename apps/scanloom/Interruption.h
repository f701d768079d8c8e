/** Ctrl-C and a service manager's stop: a verb finishes what it is at, saves, and ends with status 130. */
#pragma once

namespace scanloom
{
/** From now on the first SIGINT or SIGTERM only sets interrupted(); a second one ends the program. */
void catchInterruption();
bool interrupted();
}  // namespace scanloom
