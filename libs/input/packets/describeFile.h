#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace scanloom
{
/** What a file is, by its first bytes, for the error that refuses it: "a gzip file (a compressed capture is ...)". */
std::string describeFile(const std::filesystem::path&);

/** Whether the first bytes are those of a pcap or pcapng. */
bool beginsLikeCapture(std::string_view bytes);

/** Whether the file begins like a pcap or pcapng, also within gzip or zstd. Throws std::runtime_error if it cannot be
 * read. */
bool isCapture(const std::filesystem::path&);
}  // namespace scanloom
