#include "info.h"

#include "Arguments.h"
#include "Options.h"
#include "Verb.h"
#include "core/ConfigError.h"
#include "edit/RawlogReport.h"
#include "packets/CaptureReport.h"
#include "packets/describeFile.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct InfoArguments
{
  std::filesystem::path file;
  std::vector<std::string> metadata;
  bool digests = false;
  bool json = false;
};

int run(const InfoArguments& arguments)
{
  if (isCapture(arguments.file))
  {
    if (arguments.digests && arguments.metadata.empty())
      throw UsageError("--digests needs the sensor's metadata: --metadata FILE.json");
    const CaptureInfo info =
        captureInfo(arguments.file, arguments.metadata, arguments.digests ? Digests::Yes : Digests::No);
    std::cout << (arguments.json ? toJson(info) : toText(info));
    return info.counters.damages.empty() ? kDone : kQualityGate;
  }
  if (!arguments.metadata.empty() || arguments.digests)
    throw UsageError(
        fmt::format("{} is no capture: --metadata and --digests are for pcap and pcapng", arguments.file.string()));
  return printRawlogInfo(arguments.file, arguments.json);
}

std::function<int()> addInfoOptions(CLI::App& app)
{
  auto arguments = std::make_shared<InfoArguments>();
  addOption(app, "FILE", arguments->file, "capture (pcap, pcapng) or rawlog").required();
  addOption(app, "--metadata", arguments->metadata, "metadata JSON of a lidar in the capture (repeatable)");
  addFlag(app, "--digests", arguments->digests, "MD5 of every channel field of each turn (Ouster)");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

int printRawlogInfo(const std::filesystem::path& rawlog, bool json)
{
  const RawlogInfo info = rawlogInfo(rawlog);
  std::cout << (json ? toJson(info) : toText(info));
  return info.damage.empty() ? kDone : kQualityGate;
}

Verb infoVerb() { return {"info", "what a capture or a rawlog holds", {}, &addInfoOptions}; }
}  // namespace scanloom
