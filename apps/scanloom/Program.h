/** The frame of the program: finds the verb on the command line, runs it, and turns what it throws into a status. */
#pragma once

namespace scanloom
{
/** @return an ExitCode; messages are on stderr. */
int runProgram(int argc, const char* const* argv);
}  // namespace scanloom
