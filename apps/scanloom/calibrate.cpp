/** `scanloom calibrate`: where the lidars are on the body, from a drive. */
#include "Arguments.h"
#include "Settings.h"
#include "Verb.h"
#include "base/core/Angle.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/OutputFolder.h"
#include "base/core/jsonText.h"
#include "calibration/ExtrinsicsReport.h"
#include "calibration/ImuExtrinsicsReport.h"
#include "calibration/StaticExtrinsics.h"
#include "input/rig/InputDisplay.h"
#include "mrpt/observations/openInput.h"
#include "run/run/Calibration.h"
#include "run/run/ExtrinsicsPicture.h"
#include "run/run/ImuCalibration.h"
#include "run/run/StaticClouds.h"
#include "warn.h"

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
  bool clouds = false, clocks = false, poses_unknown = false, json = false;
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
CalibrationDrive driven(const InputSource& source, const SlamSettings& settings, Calibration& calibration)
{
  const Rig& rig = source.rig;
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  std::optional<InputDisplay> display;
  const OpenInput open = [&]
  {
    auto input = openInput(source);
    display.emplace("calibrate", *input, megabytes, "MB");
    return input;
  };
  const KeepGoing keepGoing = [&](const RunProgress& progress)
  {
    display->update(progress.share, progress.scans, {progress.recorded, progress.busy});
    return !interrupted();
  };
  const Warn warn = [&](const std::string& warning) { display->warn(warning); };
  if (!rig.body_T_imu) return driveForCalibration(*open(), calibration.reference, settings, {}, keepGoing, warn);
  const Extrinsics given{*rig.body_T_imu, 1e-3 * settings.slam.imu_delay_ms};
  ImuCalibration found = calibrateImu(open, calibration.reference, settings, given, keepGoing, warn);
  calibration.imu = std::move(found.imu);
  return std::move(found.drive);
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

/** About all lidars but the reference. `rig` is none for clouds of one instant, which have no clock. */
std::string lidarsInWords(const Calibration& calibration, const Rig* rig)
{
  std::string words;
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
  {
    if (i == calibration.reference) continue;
    TimeOffset time_offset;
    if (rig) time_offset = {rig->sensors[i].key + "_time_offset", rig->sensors[i].options.time_offset};
    words += inWords(calibration.lidars[i].name, calibration.lidars[calibration.reference].name,
                     calibration.extrinsics[i], time_offset);
  }
  return words;
}

std::string pictureOf(const MountedLidar& lidar) { return lidar.name + ".png"; }

/** All files; extrinsics.txt last, because the others only tell about it. */
std::vector<std::string> resultFiles(const std::vector<MountedLidar>& lidars)
{
  std::vector<std::string> files{"configuration.ini", "calibration.json"};
  for (const MountedLidar& lidar : lidars) files.push_back(pictureOf(lidar));
  files.emplace_back("extrinsics.txt");
  return files;
}

/** `scenes` by lidar; `configuration` is empty for clouds of one instant. */
void writeFiles(const CalibrateArguments& arguments, const Calibration& calibration,
                const std::vector<std::vector<ExtrinsicsScene>>& scenes, const std::string& configuration)
{
  OutputFolder folder(arguments.output.folder);
  const auto write = [&](const char* name, const std::string& text)
  { writeAtomically(folder.running() / name, [&](std::ostream& file) { file << text; }); };
  if (!configuration.empty()) write("configuration.ini", configuration);
  write("calibration.json", jsonText(toJson(calibration)) + "\n");
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
    if (!scenes[i].empty())
      drawExtrinsics(folder.running() / pictureOf(calibration.lidars[i]), scenes[i],
                     {calibration.lidars[calibration.reference].name, calibration.lidars[i].name});
  write("extrinsics.txt", extrinsicsText(calibration));
  const std::filesystem::path done = folder.commit(resultFiles(calibration.lidars), Completeness::Whole);
  fmt::print(stderr, "{}\n", (done / "extrinsics.txt").string());
}

int runStatic(const CalibrateArguments& arguments)
{
  const RecordingFiles recording = filesOf(arguments.recording, Clouds::Taken);
  StaticClouds clouds = readStaticClouds(recording.clouds, recording.extrinsics);
  if (arguments.poses_unknown) clouds.poses = PoseGiven::No;
  Calibration calibration;
  calibration.lidars = clouds.lidars;
  calibration.reference = indexOf(arguments.reference, calibration.lidars);
  refuseExisting(arguments.output, resultFiles(calibration.lidars));
  calibration.extrinsics = estimateStaticExtrinsics(clouds.points, calibration.reference, clouds.poses);
  std::vector<std::vector<ExtrinsicsScene>> scenes(calibration.lidars.size());
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (i != calibration.reference)
      scenes[i] = {staticScene(clouds.points[calibration.reference], clouds.points[i],
                               calibration.extrinsics[i].extrinsics.body_T_sensor)};
  writeFiles(arguments, calibration, scenes, {});
  std::cout << (arguments.json ? jsonText(toJson(calibration)) + "\n" : lidarsInWords(calibration, nullptr));
  return trusted(calibration) ? kDone : kQualityGate;
}

int noPath(const Calibration& calibration, const std::string& outcome)
{
  fmt::print(stderr,
             "scanloom calibrate: the drive cannot be localised with '{}' alone ({}), so nothing is calibrated: see "
             "that it is not covered and that the IMU's pose is right ('scanloom doctor'), or name another "
             "--reference\n",
             calibration.lidars[calibration.reference].name, outcome);
  if (calibration.imu && !hasNumbers(*calibration.imu)) fmt::print(stderr, "{}", inWords(*calibration.imu));
  return kQualityGate;
}

int contradicted(const ImuExtrinsicsEstimate& imu)
{
  fmt::print(stderr,
             "scanloom calibrate: the drive is localised with the IMU, which contradicts it, so nothing is calibrated: "
             "without 'imu_csv' and 'imu_topic' the lidars alone are calibrated\n{}",
             inWords(imu));
  return kQualityGate;
}

int runDrive(const CalibrateArguments& arguments)
{
  const RecordingFiles recording = arguments.recording.given() ? filesOf(arguments.recording) : RecordingFiles{};
  const Loaded<SlamSettings> loaded = load<SlamSettings>(arguments.configuration, recording, Poses::TakenAsZero);
  const InputSource source = sourceOf(recording, loaded.configuration);
  const Rig& rig = source.rig;
  if (source.isLive()) throw UsageError("calibrate reads captures: record a drive first ('scanloom record')");
  Calibration calibration;
  calibration.lidars = mountedLidars(setupOf(rig).header.lidars);
  refuseExisting(arguments.output, resultFiles(calibration.lidars));
  calibration.reference = indexOf(arguments.reference, calibration.lidars);
  CalibrationDrive drive = driven(source, loaded.settings, calibration);
  if (calibration.imu && calibration.imu->outcome == ImuExtrinsicsOutcome::Contradicted)
    return contradicted(*calibration.imu);
  if (!isPath(drive)) return noPath(calibration, drive.run.summary.outcome);

  const PoseGiven known =
      arguments.poses_unknown || !loaded.sensors.poses_known ? PoseGiven::No : PoseGiven::Within20Degrees;
  drive = withoutOwnParts(std::move(drive), calibration.lidars);
  const Clock clock = arguments.clocks ? Clock::Estimated : Clock::Kept;
  std::vector<std::vector<ExtrinsicsScene>> scenes(calibration.lidars.size());
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
  {
    LidarCalibration of_lidar;
    if (i != calibration.reference)
      of_lidar = calibrateLidar(i, calibration.lidars, calibration.reference, drive, clock, known);
    calibration.extrinsics.push_back(std::move(of_lidar.estimate));
    scenes[i] = std::move(of_lidar.scenes);
  }
  writeFiles(arguments, calibration, scenes, toIni(loaded));
  std::string words = lidarsInWords(calibration, &rig);
  const std::optional<GyroAgreement>& inside = drive.run.summary.imu;
  if (calibration.imu) words += inWords(*calibration.imu);
  if (!calibration.imu && inside) words += imuInWords(*inside);
  std::cout << (arguments.json ? jsonText(toJson(calibration)) + "\n" : words);
  return trusted(calibration) && (calibration.imu || imuFits(inside)) ? kDone : kQualityGate;
}

int run(CalibrateArguments arguments)
{
  if (arguments.output.folder.empty())
  {
    if (!arguments.recording.given()) throw UsageError("--out-dir is required where no RECORDING is given");
    arguments.output.folder = besideRecording(arguments.recording, "_calibration");
  }
  catchInterruption();
  try
  {
    return arguments.clouds ? runStatic(arguments) : runDrive(arguments);
  }
  catch (const Interrupted&)
  {
    return kInterrupted;
  }
}

std::function<int()> addCalibrateOptions(CLI::App& app)
{
  auto arguments = std::make_shared<CalibrateArguments>();
  addRecording(app, arguments->recording);
  const Option configuration = addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output);
  addOption(app, "--reference", arguments->reference,
            "lidar that keeps its pose, which must be right, and to which the others are calibrated [the first]")
      .typeName("NAME");
  const Option clocks = addFlag(app, "--clocks", arguments->clocks, "also estimate how late each lidar's stamps are");
  addFlag(app, "--static", arguments->clouds,
          "without a drive: RECORDING is clouds of one instant (.ply, .pcd, .bin), each named like its lidar, and a "
          "file with lines T_body_<name>")
      .excludes(configuration)
      .excludes(clocks);
  addFlag(app, "--poses-unknown", arguments->poses_unknown,
          "ignore the given poses: begin from the ground, and try all headings");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb calibrateVerb()
{
  Schema schema = rigSchema("lidars");
  merge(schema, schemaOf<SlamSettings>());
  return {"calibrate", "where the lidars and the IMU are on the body, from a drive", schema, &addCalibrateOptions};
}
}  // namespace scanloom
