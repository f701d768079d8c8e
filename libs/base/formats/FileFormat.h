/** What a file is by its first bytes: the one table of them. */
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace scanloom
{
enum class FileFormat
{
  Capture,  // pcap in both byte orders, with stamps in us or ns, and pcapng
  Ros1Bag,  // version 2.0
  Sqlite,   // a bag of ROS 2, or anything else
  Mcap,
  Other,
};

/** Of a file that begins so. */
FileFormat formatOf(std::string_view first_bytes);

/** Of what is in the file, gzip and zstd unpacked. Throws std::runtime_error if it cannot be read. */
FileFormat formatOfFile(const std::filesystem::path&);

/** What a file is, for the error that refuses it: "a zip file: unpack it first". */
std::string describeFile(const std::filesystem::path&);
}  // namespace scanloom
