#include "base/formats/CloudFile.h"

#include "base/core/Bytes.h"
#include "base/formats/CompressedFile.h"
#include "base/formats/internal/KittiReader.h"
#include "base/formats/internal/PcdReader.h"
#include "base/formats/internal/PlyReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestUnpacked = std::size_t{4} << 30;  // bytes

/** Unpacked twice, first only to be measured: no memory is taken for a file that is refused. */
std::vector<std::uint8_t> unpackedContent(const std::filesystem::path& path)
{
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument("cannot be read");
  if (!isCompressed(path)) throw std::invalid_argument("is not compressed, but its name ends in .gz");
  const std::uint64_t size = uncompressedBytes(path);
  if (size > kLargestUnpacked)
    throw std::invalid_argument(fmt::format("unpacks to {} bytes: at most 4 GB are read", size));
  std::vector<std::uint8_t> content(size);
  CompressedFile(path).read(content.data(), content.size());
  return content;
}

std::vector<std::uint8_t> plainContent(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> content(std::filesystem::file_size(path));
  if (!file.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(content.size())))
    throw std::invalid_argument("cannot be read");
  return content;
}

std::string endingOf(const std::filesystem::path& path)
{
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

CloudPoints pointsIn(const std::filesystem::path& path)
{
  const bool packed = endingOf(path) == ".gz";
  const std::string ending = endingOf(packed ? path.stem() : path);
  const auto pointsOf = ending == ".ply"   ? &plyPoints
                        : ending == ".pcd" ? &pcdPoints
                        : ending == ".bin" ? &kittiPoints
                                           : nullptr;
  if (!pointsOf)
    throw std::invalid_argument("is no cloud by its name: .ply, .pcd or .bin (KITTI) can be read, each also with .gz");
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument("is no file");
  return pointsOf(packed ? unpackedContent(path) : plainContent(path));
}

CloudFile finiteOf(CloudPoints read)
{
  CloudFile cloud{std::move(read.positions), std::move(read.times)};
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

CloudFile readCloud(const std::filesystem::path& path)
{
  try
  {
    return finiteOf(pointsIn(path));
  }
  catch (const std::logic_error& error)  // of the formats, which do not know the file's name
  {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}
}  // namespace scanloom
