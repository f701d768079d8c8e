#include "input/rig/RecordingFiles.h"

#include "base/core/ConfigError.h"
#include "base/core/naturalOrder.h"
#include "input/packets/describeFile.h"
#include "input/rig/FileKind.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
using Paths = RecordingFiles::Paths;

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

/** A folder holds what else a person put there: a file that can't be read is not of the recording. */
FileKind kindIfReadable(const std::filesystem::path& file)
try
{
  return kindOf(file);
}
catch (const std::exception&)
{
  return FileKind::Other;
}

RecordingFiles filesIn(const std::filesystem::path& folder)
{
  RecordingFiles files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file())
      if (Paths* list = listFor(kindIfReadable(entry.path()), files)) list->push_back(entry.path().lexically_normal());
  return files;
}

void append(Paths& to, const Paths& from) { to.insert(to.end(), from.begin(), from.end()); }

void append(RecordingFiles& to, const RecordingFiles& from)
{
  append(to.captures, from.captures);
  append(to.rawlogs, from.rawlogs);
  append(to.clouds, from.clouds);
  append(to.metadata, from.metadata);
  append(to.imus, from.imus);
  append(to.extrinsics, from.extrinsics);
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

/** Those that a person may have meant; empty for none. */
std::string foldersIn(const std::filesystem::path& folder)
{
  if (!std::filesystem::is_directory(folder)) return "";
  std::string names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory()) names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.path().string());
  return names.empty() ? "" : fmt::format("; folders within are not searched, name one: {}", names);
}

void sort(Paths& paths)
{
  std::sort(paths.begin(), paths.end(),
            [](const auto& a, const auto& b) { return inNaturalOrder(a.string(), b.string()); });
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
                    "clouds (PLY, PCD, KITTI){}",
                    given.empty() ? "" : given.front().string(), given.empty() ? "" : foldersIn(given.front())));
  if (!std::filesystem::is_directory(given.front())) addWhatLiesBeside(given.front(), files);
  if (!files.captures.empty() || !files.rawlogs.empty()) files.clouds.clear();
  for (Paths* list : {&files.captures, &files.rawlogs, &files.clouds, &files.metadata, &files.imus, &files.extrinsics})
    sort(*list);
  return files;
}
}  // namespace scanloom
