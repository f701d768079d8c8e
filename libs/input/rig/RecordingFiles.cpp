#include "input/rig/RecordingFiles.h"

#include "base/core/ConfigError.h"
#include "base/formats/FileFormat.h"
#include "input/rig/FileKind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace scanloom
{
namespace
{
using Paths = RecordingFiles::Paths;

constexpr std::array kLists{&RecordingFiles::captures, &RecordingFiles::rawlogs, &RecordingFiles::clouds,
                            &RecordingFiles::metadata, &RecordingFiles::imus,    &RecordingFiles::extrinsics};

constexpr std::string_view kNoImu =
    "no table of an IMU: a heading must name a stamp, gyro x y z and accel x y z, or the columns be EuRoC's: "
    "ns,gyro x,y,z (rad/s),accel x,y,z (m/s2)";

Paths* listFor(FileKind kind, RecordingFiles& files)
{
  switch (kind)
  {
    case FileKind::Capture:
      return &files.captures;
    case FileKind::Rawlog:
      return &files.rawlogs;
    case FileKind::Cloud:
      return &files.clouds;
    case FileKind::LidarMetadata:
      return &files.metadata;
    case FileKind::BodyImu:
      return &files.imus;
    case FileKind::Extrinsics:
      return &files.extrinsics;
    case FileKind::Other:
      return nullptr;
  }
  return nullptr;
}

/** By the endings of what recordings are made of. Tables and JSON of other kinds are results and references. */
bool isNamedLikeData(const std::filesystem::path& file)
{
  static constexpr std::array kEndings{".pcap", ".pcapng", ".bag", ".db3", ".mcap", ".rawlog",
                                       ".ply",  ".pcd",    ".bin", ".gz",  ".zst",  ".zstd"};
  return std::find(kEndings.begin(), kEndings.end(), file.extension().string()) != kEndings.end();
}

bool isNamedLikeImu(const std::filesystem::path& file)
{
  const std::string stem = file.stem().string();
  return file.extension() == ".csv" && (stem.find("imu") != std::string::npos || stem.find("IMU") != std::string::npos);
}

/** A folder holds what else a person put there: a file that can't be read is not of the recording. */
void addFound(const std::filesystem::path& file, RecordingFiles& files)
{
  try
  {
    if (Paths* list = listFor(kindOf(file), files))
      list->push_back(file);
    else if (isNamedLikeImu(file))
      files.unused.push_back({file, std::string(kNoImu), true, true});
    else
      files.unused.push_back({file, describeFile(file), isNamedLikeData(file), false});
  }
  catch (const std::exception& fault)
  {
    files.unused.push_back({file, fault.what(), true, false});
  }
}

/** What is used with a bag or is in it twice, and what nobody sees. */
bool goesWithAnother(const std::filesystem::path& file)
{
  const std::string ending = file.extension().string();
  return file.filename().string().front() == '.' || file.filename() == "metadata.yaml" || ending == ".db3-wal" ||
         ending == ".db3-shm";
}

RecordingFiles filesIn(const std::filesystem::path& folder)
{
  RecordingFiles files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && !goesWithAnother(entry.path())) addFound(entry.path().lexically_normal(), files);
  return files;
}

/** Moves the files of a list to those that are not used, each `as` this one. */
void setAside(Paths& paths, const UnusedFile& as, RecordingFiles& files)
{
  for (const auto& path : paths) files.unused.push_back({path, as.why, as.has_data, as.is_imu});
  paths.clear();
}

/**
 * Clouds beside captures or a rawlog are results of these. Only captures need metadata, poses and IMU samples: a rawlog
 * holds its own, and clouds are taken in their own frame; what lies beside clouds may have been meant for them.
 */
RecordingFiles withoutUnneeded(RecordingFiles files)
{
  const bool clouds_alone = files.captures.empty() && files.rawlogs.empty();
  if (!clouds_alone)
    setAside(files.clouds, {"", "a cloud, taken for a result beside the recording: name clouds to use them"}, files);
  if (!files.captures.empty()) return files;
  const std::string use = clouds_alone ? "of no use with clouds" : "a rawlog holds its own";
  setAside(files.metadata, {"", "metadata of a lidar: " + use, clouds_alone}, files);
  setAside(files.extrinsics, {"", "poses of sensors: " + use, clouds_alone}, files);
  setAside(files.imus, {"", "IMU samples: " + use, clouds_alone, clouds_alone}, files);
  return files;
}

template <typename File>
void append(std::vector<File>& to, const std::vector<File>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

void append(RecordingFiles& to, const RecordingFiles& from)
{
  for (const auto list : kLists) append(to.*list, from.*list);
  append(to.unused, from.unused);
}

void addGiven(const std::filesystem::path& path, RecordingFiles& files)
{
  if (std::filesystem::is_directory(path)) return append(files, filesIn(path));
  if (!std::filesystem::exists(path)) throw UsageError(fmt::format("{}: no such file or folder", path.string()));
  Paths* list = listFor(kindOf(path), files);
  if (!list)
    throw UsageError(
        fmt::format("{}: {}; expected a capture (pcap, pcapng), a bag (.db3, .mcap, .bag), a rawlog, clouds (PLY, PCD, "
                    "KITTI), or a "
                    "folder of them",
                    path.string(), describeFile(path)));
  list->push_back(path);
}

void addWhatLiesBeside(const std::filesystem::path& given, RecordingFiles& files)
{
  const std::filesystem::path folder = given.has_parent_path() ? given.parent_path() : ".";
  const RecordingFiles beside = filesIn(folder);
  if (files.metadata.empty()) files.metadata = beside.metadata;
  if (files.imus.empty()) files.imus = beside.imus;
  if (files.extrinsics.empty()) files.extrinsics = beside.extrinsics;
}

std::string dataIn(const std::vector<UnusedFile>& files)
{
  std::string lines;
  for (const UnusedFile& file : files)
    if (file.has_data) lines += fmt::format("\n  {}: {}", file.path.string(), file.why);
  return lines;
}

/** Those that a person may have meant; empty for none. */
std::string foldersIn(const std::filesystem::path& folder)
{
  if (!std::filesystem::is_directory(folder)) return "";
  std::string names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory()) names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.path().string());
  return names.empty() ? "" : fmt::format("; folders within are not searched, name one: {}", names);
}

/** Numbers in names count by their value: 2.bin comes before 10.bin. */
void sort(Paths& paths)
{
  std::sort(paths.begin(), paths.end(),
            [](const auto& a, const auto& b) { return ::strverscmp(a.c_str(), b.c_str()) < 0; });
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
}
}  // namespace

RecordingFiles filesOf(const std::vector<std::filesystem::path>& given)
{
  RecordingFiles files;
  for (const auto& path : given) addGiven(path, files);
  if (files.empty())
    throw UsageError(
        fmt::format("{}: holds no recording: expected captures (pcap, pcapng), bags (.db3, .mcap, .bag), a rawlog or "
                    "clouds (PLY, PCD, KITTI){}{}",
                    given.empty() ? "" : given.front().string(), given.empty() ? "" : foldersIn(given.front()),
                    dataIn(files.unused)));
  if (!files.captures.empty() && !std::filesystem::is_directory(given.front())) addWhatLiesBeside(given.front(), files);
  files = withoutUnneeded(std::move(files));
  std::sort(files.unused.begin(), files.unused.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  for (const auto list : kLists) sort(files.*list);
  return files;
}
}  // namespace scanloom
