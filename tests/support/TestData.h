/** Recordings for tests lie beside the project, not in it: tests that need them skip where they are missing. */
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace scanloom
{
/** The file or folder below $SCANLOOM_DATA, or below shared/data beside the project; nothing if it is not there. */
inline std::optional<std::filesystem::path> testData(const std::string& relative)
{
  const char* root = std::getenv("SCANLOOM_DATA");
  const std::filesystem::path folder = root ? root : std::filesystem::path(SCANLOOM_SOURCE_DIR) / "../shared/data";
  if (!std::filesystem::exists(folder / relative)) return std::nullopt;
  return folder / relative;
}

/** The file in the folder, or in one of its folders, that has this extension. */
inline std::filesystem::path theFile(const std::filesystem::path& folder, const std::string& extension)
{
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) return entry.path();
  throw std::runtime_error(folder.string() + ": has no " + extension);
}
}  // namespace scanloom

/** Declares `const std::filesystem::path name`, or skips the test. */
#define SCANLOOM_NEEDS_DATA(name, relative)                                                                         \
  const auto name##_found = scanloom::testData(relative);                                                           \
  if (!name##_found) GTEST_SKIP() << "no test data '" << (relative) << "': set SCANLOOM_DATA to the data's folder"; \
  const std::filesystem::path name = *name##_found
