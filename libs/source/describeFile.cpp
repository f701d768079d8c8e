#include "source/describeFile.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

namespace scanloom
{
namespace
{
struct Kind
{
  std::string_view begins;
  const char* what;
};
using namespace std::string_view_literals;

constexpr std::array kKinds{
    Kind{"\x1f\x8b"sv, "a gzip file (a compressed capture is read after gunzip; an MRPT rawlog is no capture)"},
    Kind{"\x28\xb5\x2f\xfd"sv, "a zstd file: unpack it first"},
    Kind{"\xfd"
         "7zXZ"sv,
         "an xz file: unpack it first"},
    Kind{"BZh"sv, "a bzip2 file: unpack it first"},
    Kind{"PK\x03\x04"sv, "a zip file: unpack it first"},
    Kind{"#ROSBAG"sv, "a ROS 1 bag"},
    Kind{"SQLite format 3"sv, "a SQLite file (a ROS 2 bag?)"},
    Kind{"\x89MCAP"sv, "an MCAP file"},
    Kind{"# .PCD"sv, "a PCD cloud"},
    Kind{"ply\n"sv, "a PLY cloud"},
    Kind{"\xd4\xc3\xb2\xa1"sv, "a damaged pcap file"},
    Kind{"\xa1\xb2\xc3\xd4"sv, "a damaged pcap file"},
    Kind{"\x4d\x3c\xb2\xa1"sv, "a damaged pcap file"},
    Kind{"\x0a\x0d\x0d\x0a"sv, "a damaged pcapng file"},
    Kind{"{"sv, "a JSON file (sensor metadata?)"},
};
}  // namespace

std::string describeFile(const std::filesystem::path& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "no such file";
  if (std::filesystem::is_directory(path, ignored)) return "a folder";
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::string("cannot be opened: ") + std::strerror(errno);

  std::array<char, 64> head{};
  file.read(head.data(), head.size());
  const std::string_view bytes(head.data(), static_cast<std::size_t>(file.gcount()));
  if (bytes.empty()) return "an empty file";
  for (const Kind& kind : kKinds)
    if (bytes.substr(0, kind.begins.size()) == kind.begins) return kind.what;

  const bool is_text = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c >= ' ' || std::isspace(c); });
  return is_text ? "a text file" : "a binary file of no kind known here";
}
}  // namespace scanloom
