#pragma once
#include <filesystem>
#include <string>

namespace scanloom
{
/** What a file is, by its first bytes, for the error that refuses it: "a gzip file (a compressed capture is ...)". */
std::string describeFile(const std::filesystem::path&);

/** Whether the file begins like a pcap or pcapng. Throws std::runtime_error if it cannot be read. */
bool isCapture(const std::filesystem::path&);
}  // namespace scanloom
