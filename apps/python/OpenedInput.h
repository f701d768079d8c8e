/** A recording or live lidars, opened as `scanloom slam` opens them. */
#pragma once
#include "SlamInput.h"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <filesystem>
#include <memory>
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

struct OpenedInput
{
  SlamInput input;
  SlamSettings settings;
  std::size_t sensors_not_used = 0;   // of the recording
  std::vector<std::string> warnings;  // what the program prints as such
  std::vector<std::string> notes;     // which lidars were recognised, which files are not used
};

/** Throws UsageError and ConfigError in the program's words. */
OpenedInput openInput(const InputArguments&);

/** A stream of Python that opens an input while other threads of Python run, and then warns as the program would. */
template <typename Stream, typename... Options>
std::unique_ptr<Stream> opened(const InputArguments& arguments, Options... options)
{
  std::unique_ptr<Stream> stream;
  {
    const pybind11::gil_scoped_release others_may_run;
    stream = std::make_unique<Stream>(arguments, options...);
  }
  stream->warnOfOpening();
  return stream;
}
}  // namespace scanloom
