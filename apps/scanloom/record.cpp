/** `scanloom record`: packets through the batcher into a rawlog. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "mrpt_bridge/RawlogWriter.h"
#include "mrpt_bridge/RigObservations.h"
#include "mrpt_bridge/SensorInput.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct RecordArguments
{
  ConfigurationArguments configuration;
  std::filesystem::path output;
  std::vector<std::string> lidars;
  bool overwrite = false;
  bool json = false;
};

struct RecordOptions
{
  int compression_level = 1;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.compression_level,
          Field{"compression_level", "", "gzip: 0 is fastest, 1 a quarter of the size, 9 too slow", between(0, 9)});
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

Recorded record(RigReplay& replay, const Rig& rig, const DriverOptions& driver, RawlogWriter& writer)
{
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  Progress progress("record", megabytes, "MB");
  Recorded recorded;
  while (const std::optional<SensorEvent> event = replay.next())
  {
    writer.write(*toObservation(*event, rig, driver));
    ++(std::holds_alternative<Scan>(*event) ? recorded.scans : recorded.imu_samples);
    progress.update(static_cast<std::uint64_t>(replay.progress() * static_cast<double>(megabytes)));
    if (interrupted()) break;
  }
  writer.close();
  return recorded;
}

void report(const RecordArguments& arguments, const Recorded& recorded, const RigReplay& replay)
{
  const auto counts = countsOf(replay);
  if (arguments.json)
  {
    const nlohmann::json result = {
        {"scans", recorded.scans}, {"imu_samples", recorded.imu_samples}, {"counts", counts}};
    std::cout << result.dump(2) << '\n';
    return;
  }
  fmt::print("{} scans and {} IMU samples in {}\n", recorded.scans, recorded.imu_samples, arguments.output.string());
  for (const BatchedLidar& lidar : replay.batcher().lidars())
  {
    const auto count = [&](const char* fate) { return counts.at(lidar.name + "." + fate); };
    fmt::print("  {}: {} blocks sent, {} emitted, {} before the start, {} invalid, {} lost, {} late, {} duplicate\n",
               lidar.name, count("blocks_sent"), count("blocks_emitted"), count("blocks_before_start"),
               count("blocks_invalid"), count("blocks_lost"), count("blocks_late"), count("blocks_duplicate"));
  }
}

int run(const RecordArguments& arguments)
{
  const Loaded<RecordSettings> loaded = load<RecordSettings>(arguments.configuration);
  const RigSettings settings = readRigSettings(loaded.configuration, rigSection(loaded.configuration));
  refuseExisting({arguments.output}, arguments.overwrite);
  const Rig rig = makeRig(settings, arguments.lidars);
  RawlogOptions options;
  options.compression_level = loaded.settings.record.compression_level;
  options.cloud_class = cloudClassFromName(settings.driver.cloud_class);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  RigReplay replay(rig);
  RawlogWriter writer(arguments.output, recordingHeader(rig), options);
  report(arguments, record(replay, rig, settings.driver, writer), replay);
  return interrupted() ? kInterrupted : kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RecordArguments>();
  addConfiguration(app, arguments->configuration)->required();
  app.add_option("-o,--output", arguments->output, "the rawlog to write")->required();
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
