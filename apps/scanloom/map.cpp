/** `scanloom map`: maps from keyframes, from a rawlog and its trajectory, or from an OctoMap; converts trajectories. */
#include "Arguments.h"
#include "Options.h"
#include "Verb.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/Progress.h"
#include "base/formats/TrajectoryReader.h"
#include "base/formats/TrajectoryWriter.h"
#include "mrpt/edit/MapFromRawlog.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/maps/MapFiles.h"
#include "mrpt/maps/OctoMapConversion.h"
#include "mrpt/maps/OctoMapEstimate.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "warn.h"

#include <fmt/format.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <limits>
#include <list>
#include <memory>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

struct MapArguments
{
  Path input, trajectory;
  std::vector<Path> outputs;
  bool overwrite = false;
  std::string preset = "inventory";
  double keyframe_distance = 4;  // m
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
    fmt::print(stderr, "warning: this machine has {:.1f} GB of memory: use a coarser --preset or a part of the input\n",
               1e-9 * memoryOfTheMachine());
}

/** For a first pose far from the origin. */
Eigen::Vector3d announcedOffset(const Rigid& first_pose)
{
  const Eigen::Vector3d offset = offsetFor(first_pose);
  if (!offset.isZero())
    fmt::print(stderr,
               "coordinates in the maps are less {:.0f} {:.0f} {:.0f} m, which LAS, PLY and PCD name in their headers; "
               "a .simplemap keeps them\n",
               offset.x(), offset.y(), offset.z());
  return offset;
}

std::vector<Path> temporariesOf(const std::list<OutputFile>& files)
{
  std::vector<Path> paths;
  for (const OutputFile& file : files) paths.push_back(file.temporary());
  return paths;
}

/** Names the files: what an interruption left does not replace a whole map. */
int finish(std::list<OutputFile>& files, const MapFiles& maps, std::size_t keyframes)
{
  const bool partial = interrupted();  // asked once: flushing to the disk gives a signal seconds to arrive
  const auto outputs = commitTogether(files, partial ? Completeness::Partial : Completeness::Whole);
  fmt::print("{} keyframes\n", keyframes);
  for (const Path& output : outputs) fmt::print("{}\n", output.string());
  if (maps.leftOut() > 0)
    warn(fmt::format("{} points are beyond the voxels of .bt and .ot: use a coarser --preset, or parts",
                     maps.leftOut()));
  if (partial) return kInterrupted;
  return maps.leftOut() > 0 ? kQualityGate : kDone;
}

int mapKeyframes(const MapArguments& arguments)
{
  const SimpleMapReader reader(arguments.input);
  announce(arguments, driveSizeOf(reader));

  std::list<OutputFile> staged(arguments.outputs.begin(), arguments.outputs.end());
  const Eigen::Vector3d offset =
      reader.size() == 0 ? Eigen::Vector3d::Zero() : announcedOffset(reader.keyframe(0).map_T_body);
  MapFiles maps(temporariesOf(staged), reader.lidars(), octoMapPreset(arguments.preset), offset);
  Progress progress("map", reader.size(), "keyframes");
  std::size_t done = 0;
  for (; done < reader.size() && !interrupted(); ++done)
  {
    const Keyframe keyframe = reader.keyframe(done);
    maps.add(keyframe);
    progress.update(done + 1);
  }
  maps.close();
  return finish(staged, maps, done);
}

int mapRawlog(const MapArguments& arguments)
{
  if (arguments.trajectory.empty())
    throw UsageError("a rawlog needs --trajectory FILE.tum, such as 'scanloom slam' writes");
  const KeyframeOptions options{readTrajectory(arguments.trajectory, &warn), arguments.keyframe_distance};
  const RecordingHeader header = required(headerOf(arguments.input));
  announce(arguments, driveSizeOf(options.trajectory, options.distance, header));

  Progress progress("map", megabytesOf({arguments.input}), "MB");
  std::size_t keyframes = 0;
  std::list<OutputFile> staged(arguments.outputs.begin(), arguments.outputs.end());
  const Eigen::Vector3d offset =
      options.trajectory.empty() ? Eigen::Vector3d::Zero() : announcedOffset(options.trajectory.front().map_T_body);
  const auto maps = std::make_shared<MapFiles>(temporariesOf(staged), mountedLidars(header.lidars),
                                               octoMapPreset(arguments.preset), offset);
  const RawlogOperation operation = toMaps(maps, options, header, [&] { ++keyframes; });
  const RawlogEdited read = readRawlog(arguments.input, operation,
                                       [&](std::uint64_t bytes)
                                       {
                                         progress.update(bytes / 1000000);
                                         return !interrupted();
                                       });
  const int status = finish(staged, *maps, keyframes);
  if (read.damage.empty()) return status;
  fmt::print(stderr, "damaged: {}: mapped up to there\n", read.damage);
  return kQualityGate;
}

int mapOctoMap(const MapArguments& arguments)
{
  requireConvertible(arguments.input, arguments.outputs);
  const auto tree = readOctoMap(arguments.input);
  convertOctoMap(*tree, arguments.outputs);
  for (const Path& output : arguments.outputs) fmt::print("{}\n", output.string());
  return kDone;
}

int convertTrajectory(const MapArguments& arguments)
{
  for (const Path& output : arguments.outputs)
  {
    if (!isTrajectoryName(output))
      throw UsageError(fmt::format("-o {}: a trajectory becomes .tum, .csv (EuRoC) or .txt (KITTI)", output.string()));
    refuseExisting(trajectoryFiles(output), arguments.overwrite);
    refuseInputsAsOutputs(trajectoryFiles(arguments.input), trajectoryFiles(output));
  }
  const Trajectory trajectory = readTrajectory(arguments.input, &warn);
  if (trajectory.empty()) throw std::runtime_error(arguments.input.string() + ": holds no pose");
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
  refuseInputsAsOutputs({arguments.input, arguments.trajectory}, arguments.outputs);
  const std::string ending = arguments.input.extension().string();
  if (!arguments.trajectory.empty() && ending != ".rawlog")
    throw UsageError(fmt::format("--trajectory is for rawlogs: {} holds poses of its own", arguments.input.string()));

  catchInterruption();
  if (ending == ".rawlog") return mapRawlog(arguments);
  if (isSimpleMap(arguments.input)) return mapKeyframes(arguments);
  if (isOctoMap(arguments.input)) return mapOctoMap(arguments);
  throw UsageError(
      fmt::format("-i {}: must be a .rawlog, .simplemap, .bt, .ot or a trajectory", arguments.input.string()));
}

std::function<int()> addMapOptions(CLI::App& app)
{
  auto arguments = std::make_shared<MapArguments>();
  addOption(app, "-i,--input", arguments->input,
            "a .rawlog with its --trajectory, a .simplemap, a .bt or a .ot; or a trajectory (.tum, .csv, .txt)")
      .required()
      .existingFile()
      .typeName("FILE");
  addOption(app, "-o,--output", arguments->outputs,
            "the file to write (repeatable); its ending is the format: .bt, .ot, .ply, .pcd, .las, .laz, .simplemap or "
            ".3Dscene; for a trajectory .tum, .csv (EuRoC) or .txt (KITTI, stamps in <name>_times.txt)")
      .required()
      .repeatable()
      .typeName("FILE");
  addOverwrite(app, arguments->overwrite);
  addOption(app, "--trajectory", arguments->trajectory,
            "for a rawlog: poses of the body as TUM, EuRoC (.csv) or KITTI (times.txt beside it)")
      .typeName("FILE");
  addOption(app, "--keyframe-distance", arguments->keyframe_distance, "for a rawlog: travel between keyframes, in m")
      .notNegative()
      .showDefault()
      .typeName("M");
  addOption(app, "--preset", arguments->preset,
            "voxels and range of .bt and .ot: preview 0.2 m / 30 m, inventory 0.1 m / 20 m, fine 0.05 m / 15 m")
      .oneOf({"preview", "inventory", "fine"})
      .showDefault()
      .typeName("NAME");
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb mapVerb()
{
  return {
      "map", "maps of a recording whose poses are known; maps and trajectories in other formats", {}, &addMapOptions};
}
}  // namespace scanloom
