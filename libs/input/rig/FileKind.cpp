#include "input/rig/FileKind.h"

#include "base/core/Text.h"
#include "base/formats/CloudFile.h"
#include "base/formats/CompressedFile.h"
#include "base/formats/FileFormat.h"
#include "base/formats/ImuCsv.h"
#include "input/bags/BagReader.h"
#include "input/lidar/LidarModels.h"
#include "input/lidar/MetadataKeys.h"
#include "input/rawlogs/PacketRawlog.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr std::size_t kBytesLookedAt = 4096;

std::string firstBytesOf(const std::filesystem::path& path)
{
  std::string bytes(kBytesLookedAt, '\0');
  CompressedFile file(path);
  bytes.resize(file.readUpTo(bytes.data(), bytes.size()));
  return bytes;
}

/** KITTI's scans have nothing but points in them: they are recognised by their ending. */
bool isCloud(std::filesystem::path path, std::string_view bytes)
{
  if (path.extension() == ".gz" || path.extension() == ".zst") path = path.stem();
  return beginsLikeCloud(bytes) || path.extension() == ".bin";
}

bool isText(std::string_view bytes)
{
  return std::all_of(bytes.begin(), bytes.end(),
                     [](unsigned char c) { return c >= ' ' || std::isspace(c) || c >= 0x80; });
}

/** The first line that is neither empty nor a comment. */
std::string firstLine(const std::string& text)
{
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos && line[begin] != '#') return line.substr(begin);
  }
  return "";
}

FileKind kindOfText(const std::filesystem::path& path, const std::string& text)
{
  const std::string first = firstLine(text);
  if (beginsWith(first, "T_body_")) return FileKind::Extrinsics;
  if (beginsLikeImuCsv(text)) return FileKind::BodyImu;
  if (beginsWith(first, "{") && isLidarMetadata(readMetadataText(path.string()))) return FileKind::LidarMetadata;
  return FileKind::Other;
}
}  // namespace

FileKind kindOf(const std::filesystem::path& path)
{
  const std::string bytes = firstBytesOf(path);
  if (formatOf(bytes) == FileFormat::Capture || isBag(path)) return FileKind::Capture;
  if (beginsLikeRawlog(bytes)) return FileKind::Rawlog;
  if (isCloud(path, bytes)) return FileKind::Cloud;
  if (!bytes.empty() && isText(bytes)) return kindOfText(path, bytes);
  return FileKind::Other;
}
}  // namespace scanloom
