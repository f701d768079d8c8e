#pragma once
#include <filesystem>
#include <string>

namespace scanloom
{
/** What a file is, by its first bytes, for the message to a person who gave the wrong one: "a gzip file, gunzip it
 * first". */
std::string describeFile(const std::filesystem::path&);
}  // namespace scanloom
