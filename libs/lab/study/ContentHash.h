/** The content of a file, and a hash that shows whether it has changed. */
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace scanloom
{
/** Throws std::runtime_error if the file cannot be read. */
std::string contentOf(const std::filesystem::path&);

/** 32 hexadecimal digits. */
std::string hashOf(std::string_view text);
}  // namespace scanloom
