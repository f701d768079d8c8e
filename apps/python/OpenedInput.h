/** A recording or live lidars, opened as `scanloom slam` opens them. */
#pragma once
#include "SlamInput.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/** What the program takes as RECORDING, -c, --set, --metadata and --lidars. */
struct InputArguments
{
  std::vector<std::filesystem::path> recording, configurations, metadata;
  std::vector<std::string> assignments, lidars;
};

enum class ImuSamples
{
  InTimeOrder,  // among the scans
  Ahead,        // those of the body by the time that a start takes: sourceForSlam()
};

struct OpenedInput
{
  SlamInput input;
  SlamSettings settings;
  std::size_t sensors_not_used = 0;   // of the recording
  std::vector<std::string> warnings;  // what the program prints as such
  std::vector<std::string> notes;     // which lidars were recognised, which files are not used
};

/** Throws UsageError and ConfigError in the program's words. */
OpenedInput openInput(const InputArguments&, ImuSamples);
}  // namespace scanloom
