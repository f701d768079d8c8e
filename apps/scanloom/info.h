#pragma once
#include <filesystem>

namespace scanloom
{
/** Prints what a rawlog holds; for `scanloom info` and `scanloom edit --info`. @return the exit status. */
int printRawlogInfo(const std::filesystem::path& rawlog, bool json);
}  // namespace scanloom
