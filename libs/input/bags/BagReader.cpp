#include "input/bags/BagReader.h"

#include "base/core/Text.h"
#include "base/formats/CompressedFile.h"
#include "base/formats/FileFormat.h"
#include "input/bags/internal/McapBag.h"
#include "input/bags/internal/McapWriter.h"
#include "input/bags/internal/MergedBags.h"
#include "input/bags/internal/RawlogBag.h"
#include "input/bags/internal/Ros1Bag.h"
#include "input/bags/internal/SqliteBag.h"
#include "input/rawlogs/PacketRawlog.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

using Open = std::unique_ptr<BagReader> (*)(const Path&);

/** Null for what is no bag of ROS. */
Open openerOf(FileFormat format)
{
  switch (format)
  {
    case FileFormat::Sqlite:
      return &openSqliteBag;
    case FileFormat::Mcap:
      return &openMcapBag;
    case FileFormat::Ros1Bag:
      return &openRos1Bag;
    case FileFormat::Capture:
    case FileFormat::Other:
      break;
  }
  return nullptr;
}

bool isBagFile(const Path& path)
try
{
  return std::filesystem::is_regular_file(path) && (openerOf(formatOfFile(path)) || isRawlogOfPackets(path));
}
catch (const std::exception&)  // what can't be read is no bag
{
  return false;
}

std::vector<Path> bagFilesIn(const Path& folder)
{
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (isBagFile(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::unique_ptr<BagReader> openFile(const Path& path)
{
  if (const Open open = openerOf(formatOfFile(path))) return open(path);
  if (isRawlogOfPackets(path)) return openRawlogBag(path);
  throw std::runtime_error(
      fmt::format("{}: no bag; expected one of ROS 2 (.db3, .mcap) or of ROS 1 (.bag, version 2.0)", path.string()));
}
}  // namespace

std::unique_ptr<BagReader> BagReader::open(const Path& path)
{
  if (!std::filesystem::is_directory(path)) return openFile(path);
  const std::vector<Path> files = bagFilesIn(path);
  if (files.empty())
    throw std::runtime_error(fmt::format("{}: holds no bag; expected .db3, .mcap or .bag files", path.string()));
  if (files.size() == 1) return openFile(files.front());
  std::vector<std::unique_ptr<BagReader>> parts;
  for (const Path& file : files) parts.push_back(openFile(file));
  return std::make_unique<MergedBags>(std::move(parts));
}

bool isBag(const Path& path)
{
  return std::filesystem::is_directory(path) ? !bagFilesIn(path).empty() : isBagFile(path);
}

bool isExportedBag(const Path& path)
{
  // The magic, kind and length of the header's record, then profile and library, each after its length of 4 bytes.
  constexpr std::size_t kLibrary = kMcapMagic.size() + 1 + 8 + 4 + kMcapProfile.size() + 4;
  if (std::filesystem::is_directory(path)) return false;
  std::string bytes(kLibrary + kMcapLibrary.size(), '\0');
  CompressedFile(path).readUpTo(bytes.data(), bytes.size());
  return formatOf(bytes) == FileFormat::Mcap && bytes.substr(kLibrary) == kMcapLibrary;
}

std::vector<BagTopic> topicsOf(const std::vector<Path>& recordings)
{
  std::vector<BagTopic> topics;
  for (const Path& path : recordings)
  {
    if (!isBag(path)) continue;
    const auto bag = BagReader::open(path);
    topics.insert(topics.end(), bag->topics().begin(), bag->topics().end());
  }
  return topics;
}

namespace
{
constexpr std::int64_t kLatestStamp = 24LL * 3600 * 365 * 145 * 1'000'000'000;  // differences can't overflow
}

Timestamp bagStamp(std::int64_t ns) { return fromNanoseconds(std::clamp<std::int64_t>(ns, 0, kLatestStamp)); }

Timestamp bagStamp(std::uint64_t ns)
{
  return fromNanoseconds(static_cast<std::int64_t>(std::min<std::uint64_t>(ns, kLatestStamp)));
}

std::string typeNameOf(const std::string& type)
{
  constexpr std::string_view kMiddle = "/msg/";
  const std::size_t middle = type.find(kMiddle);
  return middle == std::string::npos ? type : type.substr(0, middle) + "/" + type.substr(middle + kMiddle.size());
}

BagTopic declaredTopic(const std::string& name, const std::string& type, Serialisation serialisation)
{
  return {printable(name), typeNameOf(printable(type)), serialisation};
}
}  // namespace scanloom
