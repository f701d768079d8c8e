#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * For OutputFolder::commit(): the files of an export in `running`, clouds first, then the tables of their stamps; and
 * the clouds of an earlier export to the same folders, also those with higher numbers, which go.
 */
std::vector<std::string> namesOfExport(const std::filesystem::path& folder, const std::filesystem::path& running);
}  // namespace scanloom
