#include "Recording.h"

#include "base/core/ConfigError.h"
#include "base/core/Text.h"
#include "input/bags/BagReader.h"
#include "input/rig/RecognisedRig.h"
#include "input/rig/RigOptions.h"
#include "mrpt/edit/RawlogHeader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace scanloom
{
namespace
{
/** What could have been meant for the recording is a warning each; the rest is named in one line. */
void nameUnused(const std::vector<UnusedFile>& files, const Messages& messages)
{
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> data, others;
  for (const UnusedFile& file : files)
    if (file.has_data)
      data.push_back(fmt::format("{}: {}", printable(file.path.string()), file.why));
    else
      others.push_back(printable(file.path.filename().string()));
  for (std::size_t i = 0; i < std::min(data.size(), kNamed); ++i) messages.warn("not used: " + data[i]);
  if (data.size() > kNamed) messages.warn(fmt::format("not used: {} more files", data.size() - kNamed));
  if (!others.empty()) messages.say(fmt::format("not used: {}", fmt::join(others, ", ")));
}

/** A rawlog of `record`: its first object says so. */
bool isOfRecord(const std::filesystem::path& rawlog)
try
{
  return headerOf(rawlog).has_value();
}
catch (const std::exception&)  // damaged: it is for its reader to say
{
  return false;
}

using Paths = RecordingFiles::Paths;

/** Moves those of `paths` that are results, unless a person named them, to the files that are not used. */
void putAside(Paths& paths, const std::function<bool(const std::filesystem::path&)>& isResult, const std::string& why,
              std::vector<UnusedFile>& unused)
{
  const auto results = std::stable_partition(paths.begin(), paths.end(), std::not_fn(isResult));
  for (auto result = results; result != paths.end(); ++result) unused.push_back({*result, why});
  paths.erase(results, paths.end());
}

/** What `record` and `edit` wrote into the folder of a recording is a result, not another recording. */
RecordingFiles withoutResults(RecordingFiles files, const Paths& given)
{
  const auto wasGiven = [&](const std::filesystem::path& file)
  { return std::find(given.begin(), given.end(), file) != given.end(); };
  const auto isExport = [&](const std::filesystem::path& file) { return !wasGiven(file) && isExportedBag(file); };
  RecordingFiles others = files;
  putAside(others.captures, isExport, "written by 'scanloom edit --to-mcap'", others.unused);
  if (!others.captures.empty() || !others.rawlogs.empty()) files = std::move(others);  // else an export is all there is
  if (files.captures.empty()) return files;
  putAside(
      files.rawlogs, [&](const std::filesystem::path& file) { return !wasGiven(file) && isOfRecord(file); },
      "written by 'scanloom record'", files.unused);
  return files;
}
}  // namespace

Option addRecording(CLI::App& app, RecordingArguments& arguments)
{
  const Option recording = addOption(
      app, "RECORDING", arguments.paths,
      "a recording: captures (pcap, pcapng; also .gz, .zst), a bag of ROS (.db3, .mcap, .bag), a rawlog, clouds "
      "(PLY, PCD, KITTI), or a folder of these; metadata and poses of the lidars and the IMU are found beside it");
  addOption(app, "--metadata", arguments.metadata, "metadata of a lidar, instead of those beside the captures")
      .typeName("FILE")
      .repeatable();
  return recording;
}

RecordingFiles filesOf(const RecordingArguments& arguments, Clouds clouds, const Messages& messages)
{
  std::vector<std::filesystem::path> given = arguments.paths;
  given.insert(given.end(), arguments.metadata.begin(), arguments.metadata.end());
  const RecordingFiles files = withoutResults(filesOf(given), given);
  nameUnused(files.unused, messages);
  if (!files.captures.empty() && !files.rawlogs.empty())
    throw UsageError(fmt::format("{} is a capture and {} a rawlog: name one of them", files.captures.front().string(),
                                 files.rawlogs.front().string()));
  if (files.rawlogs.size() > 1)
    throw UsageError(
        fmt::format("{} and {}: two rawlogs: name one of them", files.rawlogs[0].string(), files.rawlogs[1].string()));
  if (!files.clouds.empty() && clouds == Clouds::Refused)
    throw UsageError(
        fmt::format("{}: a point cloud: slam, record, doctor, info and view take clouds, others the rawlog that "
                    "'record' makes of them",
                    files.clouds.front().string()));
  if (files.captures.empty() && !arguments.metadata.empty())
    throw UsageError("--metadata is for captures: other recordings hold the metadata");
  return files;
}

RecordedSensors addCaptures(const RecordingFiles& files, Configuration& configuration, Poses poses,
                            const Messages& messages)
{
  RecordedSensors sensors;
  sensors.not_used = static_cast<std::size_t>(
      std::count_if(files.unused.begin(), files.unused.end(), [](const UnusedFile& file) { return file.is_imu; }));
  if (files.captures.empty()) return sensors;
  if (hasRigSection(configuration))
  {
    std::vector<std::string> names;
    for (const auto& capture : files.captures) names.push_back(capture.string());
    configuration.set(fmt::format("{}.pcap_input={}", rigSection(configuration), fmt::join(names, ", ")));
    return sensors;
  }
  RecognisedRig rig = recogniseRig(files);
  for (const std::string& line : rig.found) messages.say(printable(line));
  for (const std::string& note : rig.notes) messages.warn(printable(note));
  if (poses == Poses::TakenAsZero)
    for (const std::string& key : rig.unknown_poses) rig.ini += fmt::format("{} = [0 0 0 0 0 0]\n", key);
  configuration.addDefaults(Configuration::fromText(rig.ini, "recognised"));
  sensors.poses_known = rig.poses_known;
  sensors.not_used += rig.lost.size();
  return sensors;
}

std::filesystem::path besideRecording(const RecordingArguments& arguments, const std::string& ending)
{
  const std::filesystem::path& path = arguments.paths.front();
  if (std::filesystem::is_directory(path))
  {
    std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();  // "dense/"
    return path.parent_path() / (folder.filename().string() + ending);
  }
  std::filesystem::path name = path.filename();
  if (const auto end = name.extension(); end == ".gz" || end == ".zst" || end == ".zstd") name = name.stem();
  return path.parent_path() / (name.stem().string() + ending);
}
}  // namespace scanloom
