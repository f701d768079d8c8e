/** `scanloom map`: maps of keyframes, of a rawlog along its trajectory, of an occupancy tree; or a trajectory alone. */
#include "Arguments.h"
#include "Interruption.h"
#include "Progress.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "dataset/CloudObservation.h"
#include "dataset/MapFromRawlog.h"
#include "output/MapFile.h"
#include "output/OctoMapEstimate.h"
#include "output/OctoMapFile.h"
#include "output/SceneFile.h"
#include "output/SimpleMapReader.h"
#include "output/TrajectoryFile.h"
#include "output/TrajectoryReader.h"
#include "output/VoxelPly.h"

#include <fmt/format.h>
#include <sys/sysinfo.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

struct MapArguments
{
  Path input, trajectory;
  std::vector<Path> outputs;
  bool overwrite = false, dry_run = false, quiet = false, cubes = false;
  std::string preset = "inventory";
  double keyframe_distance = 4;  // m
  int jobs = 0;
};

bool isOctoMap(const Path& path) { return path.extension() == ".bt" || path.extension() == ".ot"; }

bool writesOctoMap(const MapArguments& arguments)
{
  return std::any_of(arguments.outputs.begin(), arguments.outputs.end(), &isOctoMap);
}

double memoryOfTheMachine()
{
  struct sysinfo machine
  {
  };
  if (sysinfo(&machine) != 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(machine.totalram) * machine.mem_unit;
}

void announce(const MapArguments& arguments, const DriveSize& drive)
{
  if (!writesOctoMap(arguments)) return;
  const OctoMapOptions options = octoMapPreset(arguments.preset);
  const OctoMapCost cost = estimateOf(options, drive);
  fmt::print(
      stderr, "estimate: about {:.0f} keyframes over {:.0f} m at {} m / {} m: up to {} of one core and {:.1f} GB\n",
      drive.keyframes, drive.length, options.resolution, options.max_range, timeText(cost.seconds), 1e-9 * cost.bytes);
  if (cost.bytes > memoryOfTheMachine())
    fmt::print(stderr, "warning: this machine has {:.1f} GB: take a coarser --preset, or a part of the input\n",
               1e-9 * memoryOfTheMachine());
}

double lengthOf(const Trajectory& poses)
{
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].map_T_body.translation - poses[i - 1].map_T_body.translation).norm();
  return length;
}

using MapFileList = std::vector<std::unique_ptr<MapFile>>;

void addTo(const MapFileList& files, const Keyframe& keyframe)
{
  for (const auto& file : files) file->add(keyframe);
}

int report(const MapArguments& arguments, std::size_t keyframes)
{
  fmt::print("{} keyframes\n", keyframes);
  for (const Path& output : arguments.outputs) fmt::print("{}\n", output.string());
  return interrupted() ? kInterrupted : kDone;
}

int mapKeyframes(const MapArguments& arguments)
{
  const SimpleMapReader reader(arguments.input);
  DriveSize drive{std::vector<double>(reader.lidars().size(), 0.0), static_cast<double>(reader.size())};
  Trajectory path;
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    const Keyframe keyframe = reader.keyframe(i);
    path.push_back({keyframe.stamp, keyframe.map_T_body});
    for (const std::uint8_t id : keyframe.points.sensor_id) drive.rays[id] += 1.0 / drive.keyframes;
  }
  drive.length = lengthOf(path);
  announce(arguments, drive);
  if (arguments.dry_run) return kDone;

  const MapFileList files = makeMapFiles(arguments.outputs, reader.lidars(), octoMapPreset(arguments.preset));
  std::optional<Progress> progress;
  if (!arguments.quiet) progress.emplace("map", reader.size(), "keyframes");
  std::size_t done = 0;
  for (; done < reader.size() && !interrupted(); ++done)
  {
    addTo(files, reader.keyframe(done));
    if (progress) progress->update(done + 1);
  }
  for (const auto& file : files) file->close();
  return report(arguments, done);
}

DriveSize driveSize(const Trajectory& path, double keyframe_distance, const RecordingHeader& header)
{
  DriveSize drive;
  for (const RecordedLidar& lidar : header.lidars) drive.rays.push_back(1.0 * lidar.beams * lidar.columns);
  drive.length = lengthOf(path);
  drive.keyframes =
      keyframe_distance > 0 ? std::floor(drive.length / keyframe_distance) + 1 : static_cast<double>(path.size());
  return drive;
}

int mapRawlog(const MapArguments& arguments)
{
  if (arguments.trajectory.empty()) throw UsageError("a rawlog needs --trajectory FILE.tum: scanloom slam makes one");
  const KeyframeOptions options{readTrajectory(arguments.trajectory), arguments.keyframe_distance};
  const RecordingHeader header = required(headerOf(arguments.input));
  announce(arguments, driveSize(options.trajectory, arguments.keyframe_distance, header));
  if (arguments.dry_run) return kDone;

  const MapFileList files =
      makeMapFiles(arguments.outputs, mountedLidars(header.lidars), octoMapPreset(arguments.preset));
  std::optional<Progress> progress;
  if (!arguments.quiet) progress.emplace("map", megabytesOf({arguments.input}), "MB");
  std::size_t keyframes = 0;
  const RawlogOperation operation = overKeyframes(
      options, header,
      [&](const Keyframe& keyframe)
      {
        addTo(files, keyframe);
        ++keyframes;
      },
      [&]
      {
        for (const auto& file : files) file->close();
      });
  const RawlogEdited edited = readRawlog(arguments.input, operation,
                                         [&](std::uint64_t bytes)
                                         {
                                           if (progress) progress->update(bytes / 1000000);
                                           return !interrupted();
                                         });
  if (edited.damage.empty()) return report(arguments, keyframes);
  fmt::print(stderr, "damaged: {}: mapped up to there\n", edited.damage);
  report(arguments, keyframes);
  return kQualityGate;
}

void convert(octomap::OcTree& tree, const Path& output, const MapArguments& arguments)
{
  const std::string ending = output.extension().string();
  if (ending == ".ply") writeVoxelPly(output, tree, arguments.cubes ? VoxelShape::Cubes : VoxelShape::Centres);
  if (ending == ".ot") writeFullOctoMap(output, tree);
  if (ending == ".bt") writeBinaryOctoMap(output, tree);
  if (ending == ".3Dscene")
  {
    SceneBuilder scene;
    scene.addOccupied(tree);
    writeScene(output, *scene.finished());
  }
}

int convertOctoMap(const MapArguments& arguments)
{
  for (const Path& output : arguments.outputs)
  {
    if (output.extension() == ".simplemap")
      throw UsageError("an OctoMap holds no scans: no .simplemap can be made of it");
    if (output.extension() == ".ot" && arguments.input.extension() == ".bt")
      throw UsageError("a .bt holds no log odds: no .ot can be made of it");
  }
  const auto tree = readOctoMap(arguments.input);
  if (arguments.dry_run) return kDone;
  // A .bt changes the tree that it is made of.
  for (const Path& output : arguments.outputs)
    if (output.extension() != ".bt") convert(*tree, output, arguments);
  for (const Path& output : arguments.outputs)
    if (output.extension() == ".bt") convert(*tree, output, arguments);
  for (const Path& output : arguments.outputs) fmt::print("{}\n", output.string());
  return kDone;
}

int convertTrajectory(const MapArguments& arguments)
{
  for (const Path& output : arguments.outputs)
  {
    if (!isTrajectoryName(output))
      throw UsageError(
          fmt::format("-o {}: of a trajectory can be made .tum, .csv (EuRoC) and .txt (KITTI)", output.string()));
    refuseExisting(trajectoryFiles(output), arguments.overwrite);
  }
  const Trajectory trajectory = readTrajectory(arguments.input);
  if (trajectory.empty()) throw std::runtime_error(arguments.input.string() + ": holds no pose");
  if (arguments.dry_run) return kDone;
  for (const Path& output : arguments.outputs)
  {
    writeTrajectory(output, trajectory);
    for (const Path& file : trajectoryFiles(output)) fmt::print("{}\n", file.string());
  }
  return kDone;
}

int run(const MapArguments& arguments)
{
  if (isTrajectoryName(arguments.input)) return convertTrajectory(arguments);
  requireMapEndings(arguments.outputs);
  refuseExisting(arguments.outputs, arguments.overwrite);
  const std::string ending = arguments.input.extension().string();
  if (arguments.cubes && !isOctoMap(arguments.input)) throw UsageError("--cubes is for .bt or .ot to .ply");
  if (!arguments.trajectory.empty() && ending != ".rawlog")
    throw UsageError(fmt::format("--trajectory is for rawlogs: {} has its own poses", arguments.input.string()));

  std::optional<tbb::global_control> jobs;
  if (arguments.jobs > 0)
    jobs.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.jobs));
  catchInterruption();
  if (ending == ".rawlog") return mapRawlog(arguments);
  if (ending == ".simplemap") return mapKeyframes(arguments);
  if (isOctoMap(arguments.input)) return convertOctoMap(arguments);
  throw UsageError(
      fmt::format("-i {}: must be a .rawlog, .simplemap, .bt, .ot or a trajectory", arguments.input.string()));
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<MapArguments>();
  app.add_option("-i,--input", arguments->input,
                 "a .rawlog with its --trajectory, a .simplemap, a .bt or a .ot; or a trajectory (.tum, .csv, .txt)")
      ->required()
      ->check(CLI::ExistingFile)
      ->type_name("FILE");
  app.add_option("-o,--output", arguments->outputs,
                 "a map, by its ending .bt, .ot, .ply, .simplemap or .3Dscene; of a trajectory .tum, .csv (EuRoC) or "
                 ".txt (KITTI, stamps in <name>_times.txt) (repeatable)")
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
  addOverwrite(app, arguments->overwrite);
  app.add_option("--trajectory", arguments->trajectory,
                 "of a rawlog: the body's poses as TUM, EuRoC (.csv) or KITTI (times.txt beside it)")
      ->type_name("FILE");
  app.add_option("--keyframe-distance", arguments->keyframe_distance, "of a rawlog: travel between keyframes, in m")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->type_name("M");
  app.add_option("--preset", arguments->preset,
                 "voxels and range of .bt and .ot: preview 0.2 m / 30 m, inventory 0.1 m / 20 m, fine 0.05 m / 15 m")
      ->check(CLI::IsMember({"preview", "inventory", "fine"}))
      ->capture_default_str()
      ->type_name("NAME");
  app.add_flag("--cubes", arguments->cubes, "of a .bt or .ot: a .ply of cubes with faces, not of their centres");
  addJobs(app, arguments->jobs);
  app.add_flag("--dry-run", arguments->dry_run, "check and estimate only");
  app.add_flag("-q,--quiet", arguments->quiet, "no progress");
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb mapVerb()
{
  return {"map", "occupancy, points or keyframes of a recording whose poses are known", {}, &addOptions};
}
}  // namespace scanloom
