#include "base/formats/FileFormat.h"

#include "base/formats/CompressedFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace scanloom
{
namespace
{
struct Kind
{
  std::string_view begins;
  const char* what;
  FileFormat format = FileFormat::Other;
};
using namespace std::string_view_literals;

constexpr const char* kDamagedCapture = "a damaged capture";
constexpr std::array kKinds{
    Kind{"\xd4\xc3\xb2\xa1"sv, kDamagedCapture, FileFormat::Capture},
    Kind{"\xa1\xb2\xc3\xd4"sv, kDamagedCapture, FileFormat::Capture},
    Kind{"\x4d\x3c\xb2\xa1"sv, kDamagedCapture, FileFormat::Capture},
    Kind{"\xa1\xb2\x3c\x4d"sv, kDamagedCapture, FileFormat::Capture},
    Kind{"\x0a\x0d\x0d\x0a"sv, kDamagedCapture, FileFormat::Capture},
    Kind{"#ROSBAG V2.0\n"sv, "a ROS 1 bag", FileFormat::Ros1Bag},
    Kind{"#ROSBAG"sv, "a ROS 1 bag of another version than 2.0"},
    Kind{"SQLite format 3\0"sv, "a SQLite file (a ROS 2 bag?)", FileFormat::Sqlite},
    Kind{"\x89MCAP0\r\n"sv, "an MCAP file", FileFormat::Mcap},
    Kind{"\x1f\x8b"sv, "a gzip file that holds no capture (an MRPT rawlog?)"},
    Kind{"\x28\xb5\x2f\xfd"sv, "a zstd file that holds no capture"},
    Kind{"\xfd"
         "7zXZ"sv,
         "an xz file: unpack it first"},
    Kind{"BZh"sv, "a bzip2 file: unpack it first"},
    Kind{"PK\x03\x04"sv, "a zip file: unpack it first"},
    Kind{"# .PCD"sv, "a PCD cloud"},
    Kind{"ply\n"sv, "a PLY cloud"},
    Kind{"version https://git-lfs"sv, "a pointer of Git LFS, not the file itself: git lfs pull"},
    Kind{"\x7f"
         "ELF"sv,
         "a program"},
    Kind{"{"sv, "a JSON file (sensor metadata?)"},
};
constexpr std::size_t kLongest = 32;

/** Null if none is known that begins so. */
const Kind* kindOf(std::string_view bytes)
{
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kind& kind) { return bytes.substr(0, kind.begins.size()) == kind.begins; });
  return found == kKinds.end() ? nullptr : &*found;
}
}  // namespace

FileFormat formatOf(std::string_view first_bytes)
{
  const Kind* kind = kindOf(first_bytes);
  return kind ? kind->format : FileFormat::Other;
}

FileFormat formatOfFile(const std::filesystem::path& path)
{
  std::array<char, kLongest> bytes{};
  CompressedFile file(path);
  return formatOf(std::string_view(bytes.data(), file.readUpTo(bytes.data(), bytes.size())));
}

std::string describeFile(const std::filesystem::path& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "no such file";
  if (std::filesystem::is_directory(path, ignored)) return "a folder";
  if (!std::filesystem::is_regular_file(path, ignored)) return "a pipe or a device";  // opening it may wait for ever
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::string("cannot be opened: ") + std::strerror(errno);

  std::string bytes(kLongest, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.empty()) return "an empty file";
  if (const Kind* kind = kindOf(bytes)) return kind->what;
  const bool is_text = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c >= ' ' || std::isspace(c); });
  return is_text ? "a text file" : "a binary file of no kind known here";
}
}  // namespace scanloom
