/** The exit codes of the program; scripts rely on these numbers. */
#pragma once

namespace scanloom
{
enum ExitCode : int
{
  kDone = 0,
  kFailed = 1,        // file, device, exception
  kWrongUsage = 2,    // command line or configuration
  kQualityGate = 3,   // all outputs are written, but a quality gate failed
  kSomeFailed = 4,    // some runs of a sweep failed; the others are kept
  kInterrupted = 130  // after the outputs so far were saved
};
}  // namespace scanloom
