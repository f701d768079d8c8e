/** `scanloom record`: a rawlog of merged scans. */
#include "Arguments.h"
#include "Options.h"
#include "Recording.h"
#include "Ros2.h"
#include "Settings.h"
#include "Verb.h"
#include "Web.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/jsonText.h"
#include "input/rig/InputDisplay.h"
#include "input/rig/silentLidars.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "mrpt/observations/RigRecording.h"
#include "mrpt/observations/openInput.h"
#include "warn.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct RecordOptions
{
  int compression_level = -1;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.compression_level,
          Field{"compression_level", "",
                "gzip level: 0 is fastest, 1 gives half of the size or less; -1: 0 live, 1 from captures",
                between(-1, 9)});
  }
};

struct RecordSettings
{
  RecordOptions record;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.record, Section{"record", "how the rawlog is written"});
  }
};

struct RecordArguments
{
  ConfigurationArguments configuration;
  RecordingArguments recording;
  WebArguments web;
  Ros2Arguments ros2;
  std::filesystem::path output;  // empty: beside the recording
  std::vector<std::string> lidars;
  double seconds = 0;  // live: 0 until it is interrupted
  bool overwrite = false;
  bool json = false;
};

std::unique_ptr<InputDisplay> displayOf(const InputSource& source, SensorInput& input)
{
  if (source.isLive()) return std::make_unique<InputDisplay>("record", input);
  if (!source.clouds.empty()) return std::make_unique<InputDisplay>("record", input, source.clouds.size(), "clouds");
  return std::make_unique<InputDisplay>("record", input, megabytesOf(source.rig.captures), "MB");
}

Recorded record(SensorInput& input, const InputSource& source, const RecordArguments& arguments, RawlogWriter& writer,
                const Ros2* ros2)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Web> web =
      openWeb(arguments.web, {"record", source.isLive(), false}, input, arguments.output.parent_path());
  SensorInput& seen = web ? web->input() : input;
  const std::unique_ptr<RosTopics> topics = ros2 ? ros2->publish(false) : nullptr;
  const std::unique_ptr<SensorInput> sent = topics ? published(seen, *topics, source.isLive()) : nullptr;
  SensorInput& watched = sent ? *sent : seen;
  const std::unique_ptr<InputDisplay> display = displayOf(source, watched);
  const Recorded recorded =
      recordRig(watched, source.driver, writer,
                [&](const Recorded& so_far)
                {
                  display->update(watched.progress(), so_far.scans);
                  if (web) web->update();
                  const bool over = arguments.seconds > 0 && Clock::now() - start >= fromSeconds(arguments.seconds);
                  return !interrupted() && !over;
                });
  if (web) web->feed().end();
  return recorded;
}

/** A capture that -w replaces, out of the way until the new one is whole. */
class ReplacedCapture
{
 public:
  explicit ReplacedCapture(const std::filesystem::path& capture)
  {
    if (capture.empty() || !isTaken(capture)) return;
    kept_ = freeNameBeside(capture, "replaced");
    std::filesystem::rename(capture, kept_);
  }
  ReplacedCapture(const ReplacedCapture&) = delete;
  ReplacedCapture& operator=(const ReplacedCapture&) = delete;
  ~ReplacedCapture()
  {
    if (!kept_.empty()) warn(fmt::format("the capture that was to be replaced is now {}", kept_.string()));
  }

  void remove()
  {
    if (!kept_.empty()) std::filesystem::remove(kept_);
    kept_.clear();
  }

 private:
  std::filesystem::path kept_;
};

void report(const RecordArguments& arguments, const Recorded& recorded, const RigAccount& account,
            const std::filesystem::path& rawlog)
{
  const auto counts = countsOf(account);
  if (arguments.json)
  {
    const nlohmann::json result = {{"scans", recorded.scans},
                                   {"imu_samples", recorded.imu_samples},
                                   {"marks", recorded.marks},
                                   {"counts", counts}};
    std::cout << jsonText(result) << '\n';
    return;
  }
  fmt::print("{} scans and {} IMU samples in {}\n", recorded.scans, recorded.imu_samples, rawlog.string());
  if (recorded.marks > 0) fmt::print("  {} events were marked\n", recorded.marks);
  for (const auto& [name, lidar, of_other_senders, clock_offset] : account.lidars)
  {
    fmt::print("  {}: {} blocks sent, {} emitted, {} before the start, {} invalid, {} lost, {} late, {} duplicate\n",
               name, lidar.sent(), lidar.emitted, lidar.before_start, lidar.invalid, lidar.lost, lidar.late,
               lidar.duplicate);
    if (of_other_senders > 0) fmt::print("  {}: {} packets of other senders, left out\n", name, of_other_senders);
  }
  if (account.implausible_imu_samples > 0)
    fmt::print("  {} IMU samples with stamps of no lidar's clock, left out\n", account.implausible_imu_samples);
  for (const auto& [what, count] : account.input)
    if (count > 0 && what != "datagrams") fmt::print("  {}: {}\n", what, count);
}

std::vector<std::filesystem::path> filesReadFor(const InputSource& source, const RigSettings& settings,
                                                const RecordArguments& arguments)
{
  std::vector<std::filesystem::path> files = arguments.configuration.files;
  files.insert(files.end(), source.clouds.begin(), source.clouds.end());
  files.insert(files.end(), source.rig.captures.begin(), source.rig.captures.end());
  for (const LidarOptions& lidar : settings.lidars) files.emplace_back(lidar.metadata);
  files.emplace_back(settings.rig.extrinsics);
  files.emplace_back(settings.rig.imu_csv);
  return files;
}

InputSource sourceFor(const RecordArguments& arguments, const RecordingFiles& recording,
                      const Configuration& configuration, const Ros2* ros2)
{
  RigSettings settings;  // none of clouds
  if (recording.clouds.empty()) settings = readRigSettings(configuration, rigSection(configuration));
  std::vector<std::filesystem::path> outputs{arguments.output};
  if (settings.rig.pcap_input.empty() && !settings.rig.pcap_output.empty())
    outputs.emplace_back(settings.rig.pcap_output);
  refuseExisting(outputs, arguments.overwrite);
  InputSource source = sourceOf(recording, configuration, arguments.lidars);
  if (ros2) source.rig = ros2->live(std::move(source.rig));
  refuseInputsAsOutputs(filesReadFor(source, settings, arguments), outputs);
  return source;
}

RawlogOptions rawlogOptions(const RecordOptions& record, const DriverOptions& driver, bool live)
{
  RawlogOptions options;
  options.compression_level = record.compression_level >= 0 ? record.compression_level : live ? 0 : 1;
  cloudClassFromName(driver.cloud_class);  // throws before any file is opened
  if (live) options.safe_every = 1s;
  return options;
}

RecordingFiles recordingOf(const RecordingArguments& arguments, const Ros2* ros2)
{
  RecordingFiles files = filesOf(arguments, ros2);
  if (!files.rawlogs.empty())
    throw UsageError(fmt::format("{}: is a rawlog already: 'record' makes one of captures and clouds",
                                 arguments.paths.front().string()));
  return files;
}

/** A name that promises another format. */
void refuseOtherFormat(const std::filesystem::path& output)
{
  static constexpr std::array kOthers{".bag", ".mcap", ".db3", ".pcap", ".pcapng", ".ply", ".pcd", ".las"};
  if (std::find(kOthers.begin(), kOthers.end(), output.extension().string()) != kOthers.end())
    throw UsageError(
        fmt::format("-o {}: 'record' writes a rawlog; 'edit' makes other formats of it (--to-mcap, --export-ply, ...)",
                    output.string()));
}

std::filesystem::path defaultRawlog(const RecordingArguments& recording)
{
  if (!recording.given()) throw UsageError("-o is required where no RECORDING is given: name the rawlog to write");
  const std::filesystem::path rawlog = besideRecording(recording, ".rawlog");
  return rawlog == recording.paths.front() ? besideRecording(recording, "_scans.rawlog") : rawlog;  // one of packets
}

int run(RecordArguments arguments)
{
  if (arguments.web.given()) webAddress(arguments.web);  // it may have swallowed the recording
  if (arguments.output.empty()) arguments.output = defaultRawlog(arguments.recording);
  const std::unique_ptr<Ros2> ros2 = openRos2(arguments.ros2, "record", arguments.configuration, arguments.recording);
  const RecordingFiles recording = recordingOf(arguments.recording, ros2.get());
  const Loaded<RecordSettings> loaded = load<RecordSettings>(arguments.configuration, recording);
  const InputSource source = sourceFor(arguments, recording, loaded.configuration, ros2.get());
  refuseOtherFormat(arguments.output);
  const bool live = source.isLive();
  if (!live) refuseSeconds(arguments.seconds);
  const RawlogOptions options = rawlogOptions(loaded.settings.record, source.driver, live);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  ReplacedCapture replaced(live ? source.rig.live.capture : std::filesystem::path());
  const std::unique_ptr<SensorInput> input = openInput(source);
  RawlogWriter writer(arguments.output, input->setup().header, options);
  if (const auto& earlier = writer.earlierPart(); !earlier.empty())
    warn(fmt::format("an earlier recording did not end: what it left is now {}", earlier.string()));
  const Recorded recorded = record(*input, source, arguments, writer, ros2.get());
  // Who interrupts lidars has recorded all that there was; without a scan it is not worth an earlier recording.
  const bool partial = (interrupted() && !live) || recorded.scans == 0;
  const auto rawlog = writer.close(partial ? Completeness::Partial : Completeness::Whole);
  if (!partial) replaced.remove();
  for (const std::string& warning : input->takeWarnings()) warn(warning);
  const RigAccount account = input->account();
  report(arguments, recorded, account, rawlog);
  const std::vector<std::string> silent = silentLidars(account);
  for (const std::string& line : silent) warn(line);
  if (interrupted()) return kInterrupted;
  if (live && recorded.scans == 0)
    throw std::runtime_error(
        "no scan was recorded: check that the lidars send to this computer (udp_dest), that they use the configured "
        "ports, and that no firewall is in between ('scanloom doctor' tells more)");
  return wasReadWhole(account.input) && silent.empty() && loaded.sensors.not_used == 0 ? kDone : kQualityGate;
}

std::function<int()> addRecordOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RecordArguments>();
  addConfiguration(app, arguments->configuration);
  addDryRun(app, arguments->configuration);
  addRecording(app, arguments->recording);
  addOption(app, "-o,--output", arguments->output, "the rawlog to write; default: beside the recording");
  addSeconds(app, arguments->seconds);
  addOverwrite(app, arguments->overwrite);
  addOption(app, "--lidars", arguments->lidars, "names of the lidars to use, separated by commas (default: all)")
      .commaSeparated();
  addWeb(app, arguments->web);
  addRos2(app, arguments->ros2);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb recordVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<RecordSettings>());
  return {"record", "a rawlog of merged scans, from live lidars, captures or clouds", schema, &addRecordOptions};
}
}  // namespace scanloom
