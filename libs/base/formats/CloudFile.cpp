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
#include <functional>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestUnpacked = std::size_t{4} << 30;  // bytes

/** Clouds shrink to a third; text of round numbers to a twentieth. A file of 1 MB that is made to can hold 1 GB. */
constexpr std::size_t kMostPerPackedByte = 64;
constexpr std::size_t kAlwaysUnpacked = 64 << 20;  // bytes

/**
 * Gives the unpacked bytes to `take`, in parts. Throws std::invalid_argument if there are more than `most`, and what
 * CompressedFile throws.
 */
void unpack(const std::filesystem::path& path, std::size_t most,
            const std::function<void(const std::uint8_t*, std::size_t)>& take)
{
  if (!std::filesystem::is_regular_file(path)) throw std::invalid_argument("cannot be read");
  if (!isCompressed(path)) throw std::invalid_argument("is not compressed, but its name ends in .gz");
  CompressedFile file(path);
  std::vector<std::uint8_t> chunk(1 << 18);
  std::size_t unpacked = 0;
  while (const std::size_t got = file.readUpTo(chunk.data(), chunk.size()))
  {
    unpacked += got;
    if (unpacked > most)
      throw std::invalid_argument(
          fmt::format("unpacks to more than {} MB, {} times its size: no cloud does; if it is one, unpack it by gunzip",
                      most >> 20, most / std::max<std::size_t>(1, std::filesystem::file_size(path))));
    take(chunk.data(), got);
  }
  file.atEnd();  // throws if it is cut
}

/** Unpacked twice, first only to be measured: no memory is taken for a file that is refused. */
std::vector<std::uint8_t> unpackedContent(const std::filesystem::path& path)
{
  const std::size_t plausible = kAlwaysUnpacked + kMostPerPackedByte * std::filesystem::file_size(path);
  const std::size_t most = std::min(kLargestUnpacked, plausible);
  std::size_t size = 0;
  unpack(path, most, [&](const std::uint8_t*, std::size_t count) { size += count; });
  std::vector<std::uint8_t> content;
  content.reserve(size);
  unpack(path, most,
         [&](const std::uint8_t* bytes, std::size_t count) { content.insert(content.end(), bytes, bytes + count); });
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
