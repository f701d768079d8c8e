/** `scanloom doctor`: what is wrong with a rig, and how to mend it. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "dataset/CaptureInfo.h"
#include "dataset/CaptureRig.h"
#include "dataset/DoctorFindings.h"
#include "dataset/DoctorJson.h"
#include "dataset/LiveListening.h"
#include "dataset/RawlogEvidence.h"
#include "source/MergedCaptures.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
constexpr double kListen = 10;  // s, live: enough for a drift of 1 ppm and for a machine that sways

struct DoctorArguments
{
  ConfigurationArguments configuration;
  std::vector<std::filesystem::path> sources;
  std::vector<std::string> metadata;
  double seconds = 0;  // 0: all of a capture, kListen live
  bool json = false;
};

struct DoctorSettings : DoctorLimits
{
  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    const std::string meaning = "when doctor warns, and when it calls a rig not fit for SLAM (share: 0 to 1)";
    visit(s.delivery, Section{"doctor", meaning});
    visit(s.clocks, Section{"doctor", meaning});
    visit(s.imu, Section{"doctor", meaning});
    visit(s.geometry, Section{"doctor", meaning});
  }
};

/** From -c, or from the captures and metadata of the command line. */
Rig rigOf(const DoctorArguments& arguments, const Configuration& configuration)
{
  if (!arguments.sources.empty())
  {
    if (arguments.metadata.empty())
      throw UsageError("a capture needs its lidars' metadata: --metadata FILE.json, once per lidar; or -c CONFIG");
    return captureRig(arguments.sources, arguments.metadata);
  }
  if (!arguments.metadata.empty()) throw UsageError("--metadata goes with captures: name them, or give -c alone");
  Rig rig = makeRig(readRigSettings(configuration, rigSection(configuration)));
  for (const RigSensor& sensor : rig.sensors)
    if (!sensor.metadata)
      throw std::runtime_error(
          fmt::format("lidar '{}' cannot be examined without its metadata: {}", sensor.options.name, sensor.failure));
  return rig;
}

void listenToCaptures(RigListener& listener, const Rig& rig, double longest)
{
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  Progress progress("doctor", megabytes, "MB");
  MergedCaptures captures(rig.captures);
  Timestamp end = Timestamp::max();
  for (Datagram datagram; captures.next(datagram) && datagram.received < end && !interrupted();)
  {
    if (longest > 0 && end == Timestamp::max()) end = datagram.received + fromSeconds(longest);
    listener.add(datagram);
    progress.update(static_cast<std::uint64_t>(captures.progress() * static_cast<double>(megabytes)));
  }
}

RigEvidence listen(const Rig& rig, const DoctorArguments& arguments)
{
  RigListener listener(rig, arguments.sources.empty());
  if (!rig.captures.empty())
    listenToCaptures(listener, rig, arguments.seconds);
  else
  {
    const double longest = arguments.seconds > 0 ? arguments.seconds : kListen;
    fmt::print(stderr, "doctor: listens for {:g} s\n", longest);
    listenLive(rig, fromSeconds(longest), listener, [] { return !interrupted(); });
  }
  return listener.finish();
}

bool isRawlog(const std::vector<std::filesystem::path>& sources)
{
  return sources.size() == 1 && !isCapture(sources[0]);
}

RigEvidence read(const std::filesystem::path& rawlog, const DoctorArguments& arguments)
{
  if (!arguments.metadata.empty() || arguments.seconds > 0)
    throw UsageError(fmt::format("{} is no capture: --metadata and --seconds are for captures", rawlog.string()));
  RawlogEvidence evidence = rawlogEvidence(rawlog);
  if (!evidence.damage.empty()) fmt::print(stderr, "warning: {}\n", evidence.damage);
  return std::move(evidence.rig);
}

int run(const DoctorArguments& arguments)
{
  const Loaded<DoctorSettings> loaded = load<DoctorSettings>(arguments.configuration);
  if (arguments.sources.empty() && arguments.configuration.files.empty())
    throw UsageError("nothing to examine: name captures with --metadata, or a rawlog, or give -c CONFIG");
  const bool rawlog = isRawlog(arguments.sources);
  const std::optional<Rig> rig = rawlog ? std::nullopt : std::optional(rigOf(arguments, loaded.configuration));
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  const RigExamination examination =
      examine(rig ? listen(*rig, arguments) : read(arguments.sources.front(), arguments), loaded.settings);
  const Findings findings = findingsOf(examination, loaded.settings);
  if (arguments.json)
    std::cout << toJson(examination, findings) << '\n';
  else
    std::cout << toText(findings) << '\n' << summaryOf(findings) << '\n';
  if (interrupted()) return kInterrupted;
  return worstOf(findings) == Verdict::NotFit ? kQualityGate : kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<DoctorArguments>();
  app.add_option("SOURCE", arguments->sources,
                 "captures (pcap, pcapng) or one rawlog of scanloom's, instead of a configuration's lidars");
  app.add_option("--metadata", arguments->metadata, "metadata JSON of a lidar in the captures (repeatable)");
  addConfiguration(app, arguments->configuration);
  app.add_option("--seconds", arguments->seconds,
                 "from the start of a capture (default: all of it), or live (default: 10)")
      ->check(CLI::PositiveNumber);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb doctorVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<DoctorSettings>());
  return {"doctor", "what is wrong with a rig's lidars, clocks and poses, and how to mend it", schema, &addOptions};
}
}  // namespace scanloom
