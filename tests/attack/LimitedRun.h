/** A program under limits of time and memory. */
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct RunLimits
{
  double cpu_seconds = 0;
  double wall_seconds = 0;
  std::uint64_t address_space = 0;  // bytes, beyond which the program is refused memory; 0: no limit
};

struct RunResult
{
  int status = 0;  // of its exit
  int signal = 0;  // that ended it; 0: none
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;  // most memory that was in use at a time
  std::string errors;            // what it printed to stderr, the beginning of it
};

/**
 * Runs a program, or libscanloom_program.so, in `folder`; its standard output is thrown away. The library is loaded
 * once and each run is a fork of this process: loading the 200 libraries that MRPT needs takes 0.2 s, most verbs on a
 * small file a tenth of it. Throws std::runtime_error if it cannot be started.
 */
RunResult limitedRun(const std::vector<std::string>& command, const std::filesystem::path& folder, const RunLimits&);
}  // namespace scanloom
