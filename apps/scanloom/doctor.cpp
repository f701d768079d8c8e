/** `scanloom doctor`: faults of a rig, and how to mend them. */
#include "Arguments.h"
#include "Options.h"
#include "Ros2.h"
#include "Settings.h"
#include "Verb.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/Progress.h"
#include "diagnosis/DoctorFindings.h"
#include "diagnosis/DoctorJson.h"
#include "diagnosis/Listening.h"
#include "diagnosis/RawlogCheck.h"
#include "diagnosis/ScanEvidence.h"
#include "mrpt/observations/openInput.h"
#include "warn.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
constexpr double kListen = 10;  // s, live: enough to measure a drift of 1 ppm, and gravity on a swaying machine

struct DoctorArguments
{
  ConfigurationArguments configuration;
  RecordingArguments recording;
  double seconds = 0;  // 0: a whole capture, or kListen live
  bool json = false;
  bool ros2 = false;
};

struct DoctorSettings
{
  CropOptions crop;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.crop, Section{"crop", CropOptions::kMeaning});
  }
};

Rig rigOf(const Configuration& configuration)
{
  Rig rig = sourceOf({}, configuration).rig;
  for (const RigSensor& sensor : rig.sensors)
    if (!sensor.metadata)
      throw std::runtime_error(
          fmt::format("lidar '{}' cannot be examined without its metadata: {}", sensor.options.name, sensor.failure));
  return rig;
}

RigEvidence listen(const Rig& rig, bool poses_known, const DoctorArguments& arguments)
{
  RigListener listener(rig, poses_known);
  if (rig.captures.empty())
  {
    const double longest = arguments.seconds > 0 ? arguments.seconds : kListen;
    fmt::print(stderr, "doctor: listens for {:g} s\n", longest);
    listenLive(rig, fromSeconds(longest), listener, [] { return !interrupted(); });
    return listener.finish();
  }
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  Progress progress("doctor", megabytes, "MB");
  const std::vector<std::string> damages =
      listenToCaptures(rig, arguments.seconds > 0 ? fromSeconds(arguments.seconds) : Duration::max(), listener,
                       [&](double share)
                       {
                         progress.update(static_cast<std::uint64_t>(share * static_cast<double>(megabytes)));
                         return !interrupted();
                       });
  for (const std::string& damage : damages) warn(damage);
  return listener.finish();
}

/** Clouds name no body frame. */
RigEvidence readClouds(const RecordingFiles& recording, const Configuration& configuration)
{
  const std::unique_ptr<SensorInput> input = openInput(sourceOf(recording, configuration));
  RigEvidence evidence = scanEvidence(*input, false, [] { return !interrupted(); });
  for (const std::string& warning : input->takeWarnings()) warn(warning);
  return evidence;
}

/** Prints text or JSON. @return the exit status. */
int report(const Findings& findings, const std::string& json, const DoctorArguments& arguments)
{
  std::cout << (arguments.json ? json : toText(findings) + '\n' + summaryOf(findings)) << '\n';
  if (interrupted()) return kInterrupted;
  return worstOf(findings) == Verdict::NotFit ? kQualityGate : kDone;
}

int examineRawlog(const std::filesystem::path& rawlog, const CropOptions& crop, const DoctorArguments& arguments)
{
  Progress progress("doctor", megabytesOf({rawlog}), "MB");
  const CheckedRawlog check = checkRawlog(rawlog, crop,
                                          [&](std::uint64_t bytes)
                                          {
                                            progress.update(bytes / 1000000);
                                            return !interrupted();
                                          });
  return report(check.findings, toJson(check), arguments);
}

int run(DoctorArguments arguments)
{
  const std::unique_ptr<HeardTopics> heard = hearInstead(
      arguments.ros2, fromSeconds(arguments.seconds > 0 ? arguments.seconds : kListen), arguments.recording);
  if (!arguments.recording.given() && arguments.configuration.files.empty())
    throw UsageError("nothing to examine: name a recording, or give -c CONFIG for live lidars");
  const RecordingFiles recording =
      arguments.recording.given() ? filesOf(arguments.recording, Clouds::Taken) : RecordingFiles{};
  const Loaded<DoctorSettings> loaded = load<DoctorSettings>(arguments.configuration, recording, Poses::TakenAsZero);
  const bool scans = !recording.rawlogs.empty() || !recording.clouds.empty();
  if (scans && arguments.seconds > 0) throw UsageError("--seconds is for captures and live lidars");
  const std::optional<Rig> rig = scans ? std::nullopt : std::optional(rigOf(loaded.configuration));

  catchInterruption();
  if (!recording.rawlogs.empty()) return examineRawlog(recording.rawlogs.front(), loaded.settings.crop, arguments);
  const RigExamination examination =
      examine(rig ? listen(*rig, loaded.sensors.poses_known, arguments) : readClouds(recording, loaded.configuration),
              loaded.settings.crop);
  Findings findings = findingsOf(examination);
  if (loaded.sensors.not_used > 0)
    findings.push_back({"rig", "sensors", Verdict::NotFit,
                        fmt::format("{} of the recording cannot be used", loaded.sensors.not_used),
                        "mend what the warnings at the beginning name, or take its file away"});
  if (rig && rig->lidars.size() > 1 && !loaded.sensors.poses_known)
    findings.push_back({"rig", "poses", Verdict::NotFit, "not all poses of the lidars in the body frame are known",
                        "give them as the warnings at the beginning say, or 'scanloom calibrate' this recording"});
  return report(findings, toJson(examination, findings), arguments);
}

std::function<int()> addDoctorOptions(CLI::App& app)
{
  auto arguments = std::make_shared<DoctorArguments>();
  addRecording(app, arguments->recording);
  addConfiguration(app, arguments->configuration);
  addRos2Input(app, arguments->ros2);
  addOption(app, "--seconds", arguments->seconds,
            "how much to examine, in s: from the start of captures (default: all), or live (default: 10)")
      .positive();
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb doctorVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<DoctorSettings>());
  return {"doctor", "faults of a rig's lidars, clocks, IMUs and poses, and how to mend them", schema,
          &addDoctorOptions};
}
}  // namespace scanloom
