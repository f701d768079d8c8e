/** `scanloom calibrate`: where the lidars are on the body, from a drive. */
#include "Arguments.h"
#include "Settings.h"
#include "Verb.h"
#include "calibration/ImuMountReport.h"
#include "calibration/MountReport.h"
#include "calibration/MountSearch.h"
#include "core/Angle.h"
#include "core/AtomicFile.h"
#include "core/ConfigError.h"
#include "core/Interruption.h"
#include "core/ResultFolder.h"
#include "rig/Extrinsics.h"
#include "rig/InputDisplay.h"
#include "rig/ReadAhead.h"
#include "rig/Rig.h"
#include "rig/openRig.h"
#include "run/ImuCalibration.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct CalibrateArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  RecordingArguments recording;
  std::string reference;  // empty: the first
  bool clocks = false, poses_unknown = false, json = false;
};

const std::vector<std::string> kFiles{"configuration.ini", "extrinsics.txt", "calibration.json"};

struct Calibration
{
  std::vector<MountedLidar> lidars;
  std::size_t reference = 0;
  CalibrationDrive drive;
  std::vector<MountEstimate> mounts;    // by lidar; the reference's is not used
  std::optional<ImuMountEstimate> imu;  // none: the body has no IMU of its own
};

std::size_t indexOf(const std::string& name, const std::vector<MountedLidar>& lidars)
{
  if (lidars.size() < 2)
    throw UsageError(fmt::format("{} lidar in the configuration: two or more are needed", lidars.size()));
  if (name.empty()) return 0;
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (lidars[i].name == name) return i;
  throw UsageError(fmt::format("--reference {}: no lidar of the configuration has this name", name));
}

/** With the pose of the body's own IMU, if there is one; a lidar's comes with the lidar. */
void drive(const Rig& rig, const SlamSettings& settings, Calibration& calibration)
{
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  std::optional<InputDisplay> display;
  const OpenInput open = [&]
  {
    auto input = std::make_unique<ReadAhead>(openRig(rig));
    display.emplace("calibrate", *input, megabytes, "MB");
    return input;
  };
  const KeepGoing keepGoing = [&](const RunProgress& progress)
  {
    display->update(progress.share, progress.scans, {progress.recorded, progress.busy});
    return !interrupted();
  };
  const Warn warn = [&](const std::string& warning) { display->warn(warning); };
  if (!rig.body_T_imu)
  {
    calibration.drive = driveForCalibration(*open(), calibration.reference, settings, {}, keepGoing, warn);
    return;
  }
  const Mount given{*rig.body_T_imu, 1e-3 * settings.slam.imu_delay_ms};
  ImuCalibration told = calibrateImu(open, calibration.reference, settings, given, keepGoing, warn);
  calibration.drive = std::move(told.drive);
  calibration.imu = std::move(told.imu);
}

/** What both see at the same places nearly at once; where that is nothing, within more of the drive. */
MountEstimate estimateOf(std::size_t lidar, const Calibration& calibration, Clock clock, PoseGiven known)
{
  constexpr double kNear = 3, kFar = 8;  // m
  const CalibrationDrive& drive = calibration.drive;
  const std::vector<LidarScan>&own = drive.scans[lidar], &reference = drive.scans[calibration.reference];
  const Mount of_reference{calibration.lidars[calibration.reference].body_T_sensor, 0};
  const Mount given{calibration.lidars[lidar].body_T_sensor, 0};
  MountEstimate estimate;
  estimate.mount = given;
  for (const double reach : {kNear, kFar})
  {
    const std::vector<Station> stations = stationsOf(own, reference, of_reference, drive.trajectory, reach);
    if (stations.empty()) return estimate;
    const Mount start = findStart(stations, given, known, own, reference, of_reference.body_T_sensor, drive.trajectory);
    estimate = estimateMount(stations, given, start, drive.trajectory, clock);
    if (estimate.outcome == MountOutcome::Estimated || estimate.outcome == MountOutcome::StoodStill) break;
  }
  return estimate;
}

void writeExtrinsics(const std::filesystem::path& file, const Calibration& calibration)
{
  writeAtomically(file,
                  [&](std::ostream& out)
                  {
                    out << "# T_a_b maps coordinates in b to a: x y z yaw pitch roll (m, deg)\n";
                    for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
                    {
                      const bool given = i == calibration.reference;
                      const Rigid& pose =
                          given ? calibration.lidars[i].body_T_sensor : calibration.mounts[i].mount.body_T_sensor;
                      out << fmt::format("T_body_{} {}  # {}\n", calibration.lidars[i].name, poseText(pose),
                                         given                            ? "as given"
                                         : trusted(calibration.mounts[i]) ? "calibrated"
                                                                          : "not calibrated");
                    }
                    if (calibration.imu)
                      out << fmt::format("T_body_imu {}  # {}\n", poseText(calibration.imu->mount.body_T_sensor),
                                         trusted(*calibration.imu) ? "calibrated" : "not calibrated");
                  });
}

nlohmann::json toJson(const Calibration& calibration)
{
  nlohmann::json json{{"reference", calibration.lidars[calibration.reference].name},
                      {"lidars", nlohmann::json::array()}};
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
    if (i != calibration.reference) json["lidars"].push_back(toJson(calibration.lidars[i].name, calibration.mounts[i]));
  if (calibration.imu) json["imu"] = toJson(*calibration.imu);
  return json;
}

/** Its turn about the lidar's axes tells a wrong pose, but not well enough for a better one. */
bool imuFits(const std::optional<GyroAgreement>& imu)
{
  constexpr double kBeyondDoubt = 4;
  return !imu || imu->rotation.norm() < kBeyondDoubt * imu->sigma;
}

std::string imuInWords(const GyroAgreement& imu)
{
  return fmt::format(
      "imu: its turns are {:.2f} deg (+- {:.2f}) off those of the reference{}; its pose in the lidar is fixed\n",
      imu.rotation.norm() / kDegree, imu.sigma / kDegree,
      imuFits(imu) ? "" : ": its pose is wrong, run 'scanloom doctor'");
}

int report(const Calibration& calibration, const Rig& rig, const CalibrateArguments& arguments,
           const std::filesystem::path& folder)
{
  const std::string& reference = calibration.lidars[calibration.reference].name;
  const std::optional<GyroAgreement>& inside = calibration.drive.run.summary.imu;
  bool all = calibration.imu ? trusted(*calibration.imu) : imuFits(inside);
  std::string words;
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
  {
    if (i == calibration.reference) continue;
    const RigSensor& sensor = rig.sensors[i];
    all = all && trusted(calibration.mounts[i]);
    words += inWords(calibration.lidars[i].name, reference, calibration.mounts[i],
                     {sensor.key + "_time_offset", sensor.options.time_offset});
  }
  if (calibration.imu) words += inWords(*calibration.imu);
  if (!calibration.imu && inside) words += imuInWords(*inside);
  std::cout << (arguments.json ? toJson(calibration).dump(2) + "\n" : words);
  fmt::print(stderr, "{}\n", (folder / "extrinsics.txt").string());
  return all ? kDone : kQualityGate;
}

int run(CalibrateArguments arguments)
{
  const RecordingFiles recording = arguments.recording.given() ? filesOf(arguments.recording) : RecordingFiles{};
  if (arguments.output.folder.empty())
  {
    if (!arguments.recording.given()) throw UsageError("--out-dir is required where no RECORDING is given");
    arguments.output.folder = besideRecording(arguments.recording, "_calibration");
  }
  const Loaded<SlamSettings> loaded = load<SlamSettings>(arguments.configuration, recording, Poses::TakenAsZero);
  refuseExisting(arguments.output, kFiles);
  const Rig rig = makeRig(readRigSettings(loaded.configuration, rigSection(loaded.configuration)));
  if (rig.captures.empty()) throw UsageError("calibrate reads captures: record a drive first ('scanloom record')");
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }
  catchInterruption();
  Calibration calibration;
  calibration.lidars = mountedLidars(setupOf(rig).header.lidars);
  calibration.reference = indexOf(arguments.reference, calibration.lidars);
  drive(rig, loaded.settings, calibration);
  if (interrupted()) return kInterrupted;
  if (!isPath(calibration.drive))
  {
    fmt::print(stderr,
               "scanloom calibrate: the drive cannot be localised with '{}' alone ({}), so nothing is calibrated: see "
               "that it is not covered and that the IMU's pose is right ('scanloom doctor'), or name another "
               "--reference\n",
               calibration.lidars[calibration.reference].name, calibration.drive.run.summary.outcome);
    if (calibration.imu && !hasNumbers(*calibration.imu)) fmt::print(stderr, "{}", inWords(*calibration.imu));
    return kQualityGate;
  }

  const PoseGiven known = arguments.poses_unknown || !loaded.poses_known ? PoseGiven::No : PoseGiven::Within20Degrees;
  const Clock clock = arguments.clocks ? Clock::Estimated : Clock::Kept;
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
    calibration.mounts.push_back(i == calibration.reference ? MountEstimate{}
                                                            : estimateOf(i, calibration, clock, known));
  ResultFolder folder(arguments.output.folder);
  writeAtomically(folder.running() / kFiles[0], [&](std::ostream& file) { file << toIni(loaded); });
  writeExtrinsics(folder.running() / kFiles[1], calibration);
  writeAtomically(folder.running() / kFiles[2],
                  [&](std::ostream& file) { file << toJson(calibration).dump(2) << '\n'; });
  return report(calibration, rig, arguments, folder.commit(kFiles, Completeness::Whole));
}

std::function<int()> addCalibrateOptions(CLI::App& app)
{
  auto arguments = std::make_shared<CalibrateArguments>();
  addRecording(app, arguments->recording);
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output);
  addOption(app, "--reference", arguments->reference,
            "lidar whose pose is right, and to which the others are calibrated [the first]")
      .typeName("NAME");
  addFlag(app, "--clocks", arguments->clocks, "estimate how late each lidar's stamps are, too");
  addFlag(app, "--poses-unknown", arguments->poses_unknown,
          "begin from the ground and all headings, not from the poses of the configuration");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb calibrateVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<SlamSettings>());
  return {"calibrate", "where the lidars are on the body, from a drive", schema, &addCalibrateOptions};
}
}  // namespace scanloom
