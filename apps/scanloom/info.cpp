/** `scanloom info`: what a recording holds. */
#include "Arguments.h"
#include "Options.h"
#include "Recording.h"
#include "Ros2.h"
#include "Verb.h"
#include "base/core/ConfigError.h"
#include "input/bags/BagContents.h"
#include "input/packets/CaptureReport.h"
#include "input/rig/FoundLidars.h"
#include "mrpt/edit/RawlogReport.h"
#include "mrpt/observations/openInput.h"
#include "warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct InfoArguments
{
  RecordingArguments recording;
  bool json = false;
  bool ros2 = false;
};

/** Those that fit the capture's packets; all that were named. */
std::vector<std::string> metadataOf(const RecordingFiles& files, const RecordingArguments& arguments)
{
  std::vector<std::string> metadata;
  if (!arguments.metadata.empty())
    for (const auto& file : arguments.metadata) metadata.push_back(file.string());
  else
    try
    {
      const auto streams = streamsOf(files.captures);
      const LidarsFound found = findLidars(streams, candidatesFrom(files.metadata), files.captures);
      for (const FoundLidar& lidar : found.lidars) metadata.push_back(lidar.metadata.string());
      for (const MetadataCandidate& faulty : found.faulty) warn("not used: " + faulty.fault);
    }
    catch (const UsageError& none)
    {
      warn(none.what());
    }
  return metadata;
}

int printBagInfo(const std::filesystem::path& bag, const InfoArguments& arguments)
{
  const BagContents contents = contentsOf({bag});
  for (const std::string& warning : contents.warnings) fmt::print(stderr, "damaged: {}\n", warning);
  std::cout << (arguments.json ? toJson(contents) : bag.string() + "\n" + toText(contents)) << std::flush;
  return contents.warnings.empty() ? kDone : kQualityGate;
}

int printCaptureInfo(const RecordingFiles& files, const InfoArguments& arguments)
{
  const bool all_bags =
      std::all_of(files.captures.begin(), files.captures.end(), [](const auto& p) { return isBag(p); });
  const std::vector<std::string> metadata =
      all_bags ? std::vector<std::string>() : metadataOf(files, arguments.recording);
  if (arguments.json && files.captures.size() > 1) throw UsageError("--json is for one capture: name one");
  int status = kDone;
  for (const auto& capture : files.captures)
  {
    if (isBag(capture))
    {
      status = std::max(status, printBagInfo(capture, arguments));
      continue;
    }
    const CaptureInfo info = captureInfo(capture, metadata);
    if (files.captures.size() > 1 && !arguments.json) fmt::print("{}\n", capture.string());
    std::cout << (arguments.json ? toJson(info) : toText(info)) << std::flush;
    if (!info.counters.damages.empty()) status = kQualityGate;
  }
  return status;
}

int printCloudsInfo(const RecordingFiles& files, const InfoArguments& arguments)
{
  if (arguments.json) throw UsageError("--json is for captures, bags and rawlogs: clouds are just counted");
  const std::unique_ptr<SensorInput> clouds = openInput(sourceOf(files, {}));
  std::size_t count = 0, points = 0;
  std::optional<Timestamp> first;
  Timestamp last;
  while (const auto event = clouds->next())
  {
    const Scan& scan = std::get<Scan>(*event);
    points += scan.points.size();
    last = scan.end();
    if (!first) first = last;
    ++count;
  }
  fmt::print("{} clouds, {} points, from {:.3f} to {:.3f} s\n", count, points,
             seconds(first.value_or(last).time_since_epoch()), seconds(last.time_since_epoch()));
  for (const std::string& note : clouds->takeWarnings()) fmt::print("  {}\n", note);
  return clouds->account().input.at(kDamagedInputs) == 0 ? kDone : kQualityGate;
}

int printRawlogInfo(const std::filesystem::path& rawlog, bool json)
{
  const RawlogInfo info = rawlogInfo(rawlog);
  std::cout << (json ? toJson(info) : toText(info));
  return info.damage.empty() ? kDone : kQualityGate;
}

int run(InfoArguments arguments)
{
  constexpr Duration kHeard = 5s;
  const std::unique_ptr<HeardTopics> heard = hearInstead(arguments.ros2, kHeard, arguments.recording);
  if (!arguments.recording.given()) throw UsageError("RECORDING is required, or --ros2");
  const RecordingFiles files = filesOf(arguments.recording, Clouds::Taken);
  if (!files.clouds.empty()) return printCloudsInfo(files, arguments);
  if (!files.captures.empty()) return printCaptureInfo(files, arguments);
  return printRawlogInfo(files.rawlogs.front(), arguments.json);
}

std::function<int()> addInfoOptions(CLI::App& app)
{
  auto arguments = std::make_shared<InfoArguments>();
  addRecording(app, arguments->recording);
  addRos2Input(app, arguments->ros2);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb infoVerb() { return {"info", "what a capture, a bag, a rawlog or clouds hold", {}, &addInfoOptions}; }
}  // namespace scanloom
