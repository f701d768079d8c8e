/** `scanloom doctor`: what is wrong with a rig, and how to mend it. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "dataset/CaptureRig.h"
#include "dataset/DoctorFindings.h"
#include "dataset/DoctorJson.h"
#include "source/MergedCaptures.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct DoctorArguments
{
  ConfigurationArguments configuration;
  std::vector<std::filesystem::path> captures;
  std::vector<std::string> metadata;
  double seconds = 0;  // 0: all of a capture
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
  if (!arguments.captures.empty())
  {
    if (arguments.metadata.empty())
      throw UsageError("a capture needs its lidars' metadata: --metadata FILE.json, once per lidar; or -c CONFIG");
    return captureRig(arguments.captures, arguments.metadata);
  }
  if (!arguments.metadata.empty()) throw UsageError("--metadata goes with captures: name them, or give -c alone");
  const std::string section = rigSection(configuration);
  Rig rig = makeRig(readRigSettings(configuration, section));
  if (rig.captures.empty()) throw ConfigError(fmt::format("[{}] pcap_input is missing: nothing to examine", section));
  return rig;
}

void listen(RigListener& listener, const Rig& rig, double longest)
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

int run(const DoctorArguments& arguments)
{
  const Loaded<DoctorSettings> loaded = load<DoctorSettings>(arguments.configuration);
  const Rig rig = rigOf(arguments, loaded.configuration);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  RigListener listener(rig, arguments.captures.empty());
  listen(listener, rig, arguments.seconds);
  const RigExamination examination = examine(listener.finish(), loaded.settings);
  const Findings findings = findingsOf(examination, loaded.settings);
  if (arguments.json)
    std::cout << toJson(examination, findings) << '\n';
  else
    std::cout << toText(findings);
  if (interrupted()) return kInterrupted;
  return worstOf(findings) == Verdict::NotFit ? kQualityGate : kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<DoctorArguments>();
  app.add_option("CAPTURE", arguments->captures, "captures (pcap, pcapng) instead of a configuration's");
  app.add_option("--metadata", arguments->metadata, "metadata JSON of a lidar in the captures (repeatable)");
  addConfiguration(app, arguments->configuration);
  app.add_option("--seconds", arguments->seconds, "of the recording, from its start; all of it if not given")
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
