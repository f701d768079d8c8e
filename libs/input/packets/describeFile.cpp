#include "input/packets/describeFile.h"

#include "base/formats/CompressedFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
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
    Kind{"\x1f\x8b"sv, "a gzip file that holds no capture (an MRPT rawlog?)"},
    Kind{"\x28\xb5\x2f\xfd"sv, "a zstd file that holds no capture"},
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
    Kind{"version https://git-lfs"sv, "a pointer of Git LFS, not the file itself: git lfs pull"},
    Kind{"\x7f"
         "ELF"sv,
         "a program"},
    Kind{"{"sv, "a JSON file (sensor metadata?)"},
};

/** pcap in both byte orders, with stamps in microseconds and in nanoseconds, and pcapng. */
constexpr std::array kCaptures{"\xd4\xc3\xb2\xa1"sv, "\xa1\xb2\xc3\xd4"sv, "\x4d\x3c\xb2\xa1"sv, "\xa1\xb2\x3c\x4d"sv,
                               "\x0a\x0d\x0d\x0a"sv};

std::string firstBytesOf(std::istream& file)
{
  std::string bytes(64, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace

bool beginsLikeCapture(std::string_view bytes)
{
  return std::any_of(kCaptures.begin(), kCaptures.end(),
                     [&](std::string_view magic) { return bytes.substr(0, magic.size()) == magic; });
}

std::string describeFile(const std::filesystem::path& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "no such file";
  if (std::filesystem::is_directory(path, ignored)) return "a folder";
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::string("cannot be opened: ") + std::strerror(errno);

  const std::string bytes = firstBytesOf(file);
  if (bytes.empty()) return "an empty file";
  if (beginsLikeCapture(bytes)) return "a damaged capture";
  for (const Kind& kind : kKinds)
    if (bytes.compare(0, kind.begins.size(), kind.begins) == 0) return kind.what;

  const bool is_text = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c >= ' ' || std::isspace(c); });
  return is_text ? "a text file" : "a binary file of no kind known here";
}

bool isCapture(const std::filesystem::path& path)
{
  if (!std::ifstream(path, std::ios::binary))
    throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  std::array<char, 4> bytes{};
  CompressedFile file(path);
  return beginsLikeCapture({bytes.data(), file.readUpTo(bytes.data(), bytes.size())});
}
}  // namespace scanloom
