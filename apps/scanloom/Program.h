/** Parses the command line, runs its verb, and turns exceptions into messages and exit codes. */
#pragma once

namespace scanloom
{
/** @return an ExitCode; messages go to stderr. */
int runProgram(int argc, const char* const* argv);
}  // namespace scanloom
