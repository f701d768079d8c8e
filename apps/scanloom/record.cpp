/** `scanloom record`: packets, live or of captures, through the batcher into a rawlog. */
#include "Arguments.h"
#include "InputDisplay.h"
#include "Interruption.h"
#include "Settings.h"
#include "SimulatedRig.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "mrpt_bridge/RawlogWriter.h"
#include "mrpt_bridge/RigObservations.h"
#include "mrpt_bridge/SensorInput.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

namespace scanloom
{
namespace
{
struct RecordArguments
{
  ConfigurationArguments configuration;
  SceneArguments scene;
  std::filesystem::path output;
  std::vector<std::string> lidars;
  double seconds = 0;  // live: 0 until it is interrupted
  bool overwrite = false;
  bool json = false;
};

struct RecordOptions
{
  int compression_level = -1;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(
        o.compression_level,
        Field{"compression_level", "",
              "gzip: 0 is fastest, 1 a quarter of the size, 9 too slow; -1: 0 live, 1 from captures", between(-1, 9)});
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

struct Recorded
{
  std::uint64_t scans = 0, imu_samples = 0;
};

/** Where the sensors' events come from. */
struct Source
{
  DriverOptions driver;
  Rig rig;
  std::shared_ptr<const Scene> scene;  // none: captures or sockets
  std::filesystem::path capture;       // that is written beside; empty: none

  bool isLive() const { return !scene && rig.captures.empty(); }
};

InputDisplay displayOf(const Source& source, RigInput& input)
{
  if (source.isLive()) return {"record", input};
  if (source.scene) return {"record", static_cast<std::uint64_t>(std::ceil(source.scene->span.duration)), "s"};
  return {"record", megabytesOf(source.rig.captures), "MB"};
}

Recorded record(RigInput& input, const Source& source, double seconds, RawlogWriter& writer)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Rig rig = source.rig;
  InputDisplay display = displayOf(source, input);
  Recorded recorded;
  while (!input.ended())
  {
    if (const std::optional<SensorEvent> event = input.next(100ms))
    {
      input.refresh(rig);
      writer.write(*toObservation(*event, rig, source.driver));
      if (std::holds_alternative<Scan>(*event)) ++recorded.scans;
      if (std::holds_alternative<SensorImu>(*event)) ++recorded.imu_samples;
    }
    writer.secure();
    display.update(input.progress(), recorded.scans);
    const bool over = seconds > 0 && Clock::now() - start >= fromSeconds(seconds);
    if (interrupted() || over) input.stop();
  }
  writer.close();
  return recorded;
}

void report(const RecordArguments& arguments, const Recorded& recorded, const RigAccount& account)
{
  const auto counts = countsOf(account);
  if (arguments.json)
  {
    const nlohmann::json result = {
        {"scans", recorded.scans}, {"imu_samples", recorded.imu_samples}, {"counts", counts}};
    std::cout << result.dump(2) << '\n';
    return;
  }
  fmt::print("{} scans and {} IMU samples in {}\n", recorded.scans, recorded.imu_samples, arguments.output.string());
  for (const auto& [name, lidar] : account.lidars)
    fmt::print("  {}: {} blocks sent, {} emitted, {} before the start, {} invalid, {} lost, {} late, {} duplicate\n",
               name, lidar.sent(), lidar.emitted, lidar.before_start, lidar.invalid, lidar.lost, lidar.late,
               lidar.duplicate);
  for (const auto& [what, count] : account.input)
    if (count > 0 && what != "datagrams") fmt::print("  {}: {}\n", what, count);
}

Source openSource(const RecordArguments& arguments, const Configuration& configuration)
{
  if (arguments.scene.given())
  {
    refuseExisting({arguments.output}, arguments.overwrite);
    SimulatedRig simulated = simulatedRig(arguments.scene, configuration, arguments.lidars);
    const bool has_rig = hasRigSection(configuration);
    return {has_rig ? configuration.read<DriverOptions>(rigSection(configuration)) : DriverOptions{},
            std::move(simulated.rig),
            std::move(simulated.scene),
            {}};
  }
  const RigSettings settings = readRigSettings(configuration, rigSection(configuration));
  const bool live = settings.rig.pcap_input.empty();
  std::vector<std::filesystem::path> outputs{arguments.output};
  if (live && !settings.rig.pcap_output.empty()) outputs.emplace_back(settings.rig.pcap_output);
  refuseExisting(outputs, arguments.overwrite);
  return {settings.driver, makeRig(settings, arguments.lidars), nullptr, live ? settings.rig.pcap_output : ""};
}

RawlogOptions rawlogOptions(const RecordOptions& record, const DriverOptions& driver, bool live)
{
  RawlogOptions options;
  options.compression_level = record.compression_level >= 0 ? record.compression_level : live ? 0 : 1;
  options.cloud_class = cloudClassFromName(driver.cloud_class);
  if (live) options.safe_every = 1s;
  return options;
}

int run(const RecordArguments& arguments)
{
  const Loaded<RecordSettings> loaded = load<RecordSettings>(withScene(arguments.configuration, arguments.scene));
  const Source source = openSource(arguments, loaded.configuration);
  const bool live = source.isLive();
  if (!live) refuseSeconds(arguments.seconds);
  const RawlogOptions options = rawlogOptions(loaded.settings.record, source.driver, live);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  if (!source.capture.empty()) std::filesystem::remove(source.capture);  // -w was given
  const std::unique_ptr<RigInput> input =
      source.scene ? makeSceneRigInput(source.scene, source.rig) : openRig(source.rig);
  RawlogWriter writer(arguments.output, recordingHeader(source.rig), options);
  const Recorded recorded = record(*input, source, arguments.seconds, writer);
  for (const std::string& warning : input->takeWarnings()) fmt::print(stderr, "warning: {}\n", warning);
  report(arguments, recorded, input->account());
  if (interrupted()) return kInterrupted;
  if (live && recorded.scans == 0)
    throw std::runtime_error(
        "no scan was recorded: see that the lidars' destination (udp_dest) is this computer, that their ports are the "
        "configured ones, and that no firewall is between ('scanloom doctor' looks closer)");
  return kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RecordArguments>();
  addConfiguration(app, arguments->configuration);
  addScene(app, arguments->scene);
  app.add_option("-o,--output", arguments->output, "the rawlog to write")->required();
  addSeconds(app, arguments->seconds);
  addOverwrite(app, arguments->overwrite);
  app.add_option("--lidars", arguments->lidars, "names of the lidars to use, separated by commas")->delimiter(',');
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb recordVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<RecordSettings>());
  return {"record", "packets of all lidars into a rawlog of scans", schema, &addOptions};
}
}  // namespace scanloom
