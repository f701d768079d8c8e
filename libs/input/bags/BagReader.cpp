#include "input/bags/BagReader.h"

#include "base/formats/CompressedFile.h"
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
using namespace std::string_view_literals;
using Path = std::filesystem::path;

struct Container
{
  std::string_view begins;
  std::unique_ptr<BagReader> (*open)(const Path&);
};

const Container kContainers[] = {
    {"SQLite format 3\0"sv, &openSqliteBag}, {kMcapMagic, &openMcapBag}, {"#ROSBAG V2.0\n"sv, &openRos1Bag}};

/** Null if it is none. Throws std::runtime_error if the file cannot be read. */
const Container* containerOf(const Path& path)
{
  std::string bytes(16, '\0');
  CompressedFile file(path);
  bytes.resize(file.readUpTo(bytes.data(), bytes.size()));
  const auto found = std::find_if(std::begin(kContainers), std::end(kContainers),
                                  [&](const Container& c) { return bytes.compare(0, c.begins.size(), c.begins) == 0; });
  return found == std::end(kContainers) ? nullptr : found;
}

bool isBagFile(const Path& path)
try
{
  return std::filesystem::is_regular_file(path) && (containerOf(path) || isRawlogOfPackets(path));
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
  const Container* container = containerOf(path);
  if (!container && isRawlogOfPackets(path)) return openRawlogBag(path);
  if (!container)
    throw std::runtime_error(
        fmt::format("{}: no bag; expected one of ROS 2 (.db3, .mcap) or of ROS 1 (.bag, version 2.0)", path.string()));
  return container->open(path);
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
  if (std::filesystem::is_directory(path) || !isBagFile(path)) return false;
  std::string bytes(kLibrary + kMcapLibrary.size(), '\0');
  CompressedFile(path).readUpTo(bytes.data(), bytes.size());
  return bytes.compare(0, kMcapMagic.size(), kMcapMagic) == 0 && bytes.substr(kLibrary) == kMcapLibrary;
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
}  // namespace scanloom
