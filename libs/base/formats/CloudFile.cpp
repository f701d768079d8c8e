#include "base/formats/CloudFile.h"

#include "base/core/Bytes.h"
#include "base/core/Text.h"
#include "base/formats/CompressedFile.h"
#include "base/formats/internal/FloatsReader.h"
#include "base/formats/internal/PcdReader.h"
#include "base/formats/internal/PlyReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestUnpacked = std::size_t{4} << 30;  // bytes

/** A compressed file is unpacked twice, first only to be measured: no memory is taken for a file that is refused. */
std::vector<std::uint8_t> contentOf(const std::filesystem::path& path)
{
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument("is no file");
  const std::uint64_t size = isCompressed(path) ? uncompressedBytes(path) : std::filesystem::file_size(path);
  if (size > kLargestUnpacked) throw std::invalid_argument(fmt::format("has {} bytes: at most 4 GB are read", size));
  std::vector<std::uint8_t> content(size);
  CompressedFile(path).read(content.data(), content.size());
  return content;
}

std::string endingOf(const std::filesystem::path& path) { return lowerCase(path.extension().string()); }

/** "ply" and the end of the line, or blanks that an editor has left before it. */
bool beginsLikePly(std::string_view bytes)
{
  return beginsWith(bytes, "ply") && bytes.size() > 3 && std::isspace(static_cast<unsigned char>(bytes[3]));
}

/** Comments, with which PCL begins, and the version (".7", "0.7") may be missing. */
bool beginsLikePcd(std::string_view bytes)
{
  while (beginsWith(bytes, "#") && bytes.find('\n') != std::string_view::npos)
    bytes.remove_prefix(bytes.find('\n') + 1);
  return beginsWith(bytes, "VERSION .") || beginsWith(bytes, "VERSION 0.") || beginsWith(bytes, "FIELDS ");
}

/** The name says what a file was meant to be where its first bytes say nothing. */
CloudPoints pointsIn(const std::filesystem::path& path)
{
  const std::vector<std::uint8_t> content = contentOf(path);
  const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
  const std::string packing = endingOf(path);
  const std::string ending = packing == ".gz" || packing == ".zst" ? endingOf(path.stem()) : packing;
  if (beginsWith(bytes, "version https://git-lfs"))
    throw std::invalid_argument("is a pointer of Git LFS, not the file itself: git lfs pull");
  if (beginsLikePly(bytes) || ending == ".ply") return plyPoints(content);
  if (beginsLikePcd(bytes) || ending == ".pcd") return pcdPoints(content);
  if (ending == ".bin") return pointsOfFloats(content);
  throw std::invalid_argument("is no cloud by its name or its first bytes: PLY, PCD and .bin (KITTI) are read");
}

CloudFile finiteOf(CloudPoints read)
{
  CloudFile cloud{std::move(read.positions), std::move(read.times), 0, std::move(read.note)};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
  {
    const bool timed = cloud.times.empty() || std::isfinite(cloud.times[i]);
    if (!cloud.points[i].allFinite() || !timed) continue;
    cloud.points[kept] = cloud.points[i];
    if (!cloud.times.empty()) cloud.times[kept] = cloud.times[i];
    ++kept;
  }
  cloud.dropped = cloud.points.size() - kept;
  cloud.points.resize(kept);
  if (!cloud.times.empty()) cloud.times.resize(kept);
  return cloud;
}
}  // namespace

bool beginsLikeCloud(std::string_view bytes) { return beginsLikePly(bytes) || beginsLikePcd(bytes); }

CloudFile readCloud(const std::filesystem::path& path)
{
  try
  {
    return finiteOf(pointsIn(path));
  }
  catch (const std::logic_error& error)  // of the formats, which do not know the file's name
  {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), printable(error.what())));
  }
}
}  // namespace scanloom
