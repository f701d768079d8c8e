/** `scanloom view`: plays a recording on a page, shows another file in a window, or draws either. */
#include "Arguments.h"
#include "Devices.h"
#include "Recording.h"
#include "Ros2.h"
#include "Verb.h"
#include "Web.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/formats/CloudFile.h"
#include "base/formats/FileFormat.h"
#include "base/formats/TrajectoryReader.h"
#include "base/formats/TrajectoryWriter.h"
#include "input/bags/BagReader.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/SceneFile.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/openInput.h"
#include "run/page/Player.h"
#include "run/page/SiteServer.h"
#include "warn.h"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

constexpr int kWidth = 1280, kHeight = 960;  // pixels, of a window or a picture

struct ViewArguments
{
  Path file, png, trajectory;
  WebArguments web;
  Ros2Arguments ros2;
  std::optional<std::uint64_t> scan;
  bool overwrite = false;
};

void addScan(SceneBuilder& scene, const Path& path, std::uint64_t wanted)
{
  ObservationReader reader(path);
  std::uint64_t clouds = 0;
  while (const ObservationPtr observation = reader.next())
    if (const auto cloud = cloudIn(observation); cloud && clouds++ == wanted)
      return scene.addPoints(positionsInBody(*cloud));
  const std::string damage = reader.damage().empty() ? "" : fmt::format("; the file is damaged: {}", reader.damage());
  throw std::runtime_error(
      fmt::format("{}: has {} point clouds, so there is no number {}{}", path.string(), clouds, wanted, damage));
}

std::vector<Eigen::Vector3f> positionsOf(const PointCloud& cloud)
{
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < cloud.size(); ++i) positions.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  return positions;
}

InputSource sourceAt(const Path& path)
{
  const RecordingFiles files = filesOf(RecordingArguments{{path}, {}}, Clouds::Taken);
  Configuration configuration;
  addCaptures(files, configuration);
  return sourceOf(files, configuration);
}

void addRecordedScan(SceneBuilder& scene, const Path& path, std::uint64_t wanted)
{
  const std::unique_ptr<SensorInput> input = openInput(sourceAt(path));
  std::uint64_t scans = 0;
  while (const std::optional<SensorEvent> event = input->next())
    if (const auto* scan = std::get_if<Scan>(&*event); scan && scans++ == wanted)
      return scene.addPoints(positionsOf(scan->points));
  throw std::runtime_error(fmt::format("{}: has {} scans, so there is no number {}", path.string(), scans, wanted));
}

void addKeyframes(SceneBuilder& scene, const Path& path)
{
  const SimpleMapReader reader(path);
  Trajectory poses;
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    const Keyframe keyframe = reader.keyframe(i);
    scene.addKeyframe(keyframe);
    poses.push_back({keyframe.stamp, keyframe.map_T_body});
  }
  scene.addPath(poses);
}

/** A rawlog with packets is one, too; a folder may be of clouds. */
bool isOfPackets(const Path& file)
{
  return std::filesystem::is_directory(file) || formatOfFile(file) == FileFormat::Capture || isBag(file);
}

SceneBuilder sceneOf(const ViewArguments& arguments)
{
  SceneBuilder scene;
  const std::string ending = arguments.file.extension().string();
  if (isOfPackets(arguments.file))
    addRecordedScan(scene, arguments.file, arguments.scan.value_or(0));
  else if (ending == ".rawlog")
    addScan(scene, arguments.file, arguments.scan.value_or(0));
  else if (isSimpleMap(arguments.file))
    addKeyframes(scene, arguments.file);
  else if (ending == ".bt" || ending == ".ot")
    scene.addOccupied(*readOctoMap(arguments.file));
  else if (isTrajectoryName(arguments.file))
    scene.addPath(readTrajectory(arguments.file, &warn));
  else if (ending == ".ply" || ending == ".pcd" || ending == ".bin" || ending == ".gz")
    scene.addPoints(readCloud(arguments.file).points);
  else
    throw UsageError(
        fmt::format("{}: must be a capture, a bag, .rawlog, .simplemap, .bt, .ot, .ply, .pcd, .bin or a trajectory",
                    arguments.file.string()));
  return scene;
}

int show(const MrptScene::Ptr& scene, const ViewArguments& arguments)
{
  const std::unique_ptr<Window> window =
      devices().showScene(arguments.file.filename().string(), scene, kWidth, kHeight);
  while (window->isOpen() && !interrupted()) std::this_thread::sleep_for(50ms);
  return interrupted() ? kInterrupted : kDone;
}

bool isRecording(const Path& file) { return file.extension() == ".rawlog" || isOfPackets(file); }

/** What is played goes to `topics`, too, if there are any. */
Player::Open openerOf(const Path& file, const Trajectory& poses, RosTopics* topics)
{
  if (!isRecording(file))
    throw UsageError(fmt::format(
        "{}: --web and --ros2 play a capture, a bag, a folder of these or a .rawlog; others are shown in a window",
        file.string()));
  return [source = sourceAt(file), poses, topics]() -> std::unique_ptr<SensorInput>
  {
    std::unique_ptr<SensorInput> input = openInput(source);
    if (!topics) return input;
    return std::make_unique<PublishedInput>(std::move(input), *topics, PublishedInput::Pace::OfInput, poses);
  };
}

int play(const ViewArguments& arguments)
{
  Trajectory poses;
  if (!arguments.trajectory.empty()) poses = readTrajectory(arguments.trajectory, &warn);
  LiveExchange exchange;
  const std::unique_ptr<Ros2> ros2 = openRos2(arguments.ros2, "view", {}, RecordingArguments{{arguments.file}, {}});
  const std::unique_ptr<RosTopics> topics = ros2 ? ros2->publish(!poses.empty()) : nullptr;
  Player player(openerOf(arguments.file, poses, topics.get()), poses, exchange);
  const SensorAddress address = webAddress(arguments.web);
  const LiveServer server(address, exchange);
  announcePage(server.url(), address);
  fmt::print(stderr, "Ctrl-C ends it\n");
  player.run([] { return !interrupted(); });
  return kDone;
}

int showSite(const ViewArguments& arguments)
{
  if (arguments.ros2.given() || arguments.scan || !arguments.trajectory.empty())
    throw UsageError(fmt::format("{}: a site is shown on a page, with --web alone", arguments.file.string()));
  const SensorAddress address = webAddress(arguments.web);
  const SiteServer server(address, arguments.file);
  announcePage(server.url(), address);
  fmt::print(stderr, "Ctrl-C ends it\n");
  while (!interrupted()) std::this_thread::sleep_for(50ms);
  return kDone;
}

int draw(const ViewArguments& arguments)
{
  if (arguments.png.extension() != ".png")
    throw UsageError(fmt::format("--png {}: the name must end in .png", arguments.png.string()));
  refuseExisting({arguments.png}, arguments.overwrite);
  writePicture(arguments.png, *sceneOf(arguments).finished(), kWidth, kHeight);
  fmt::print("{}\n", arguments.png.string());
  return kDone;
}

int run(const ViewArguments& arguments)
{
  if (!std::filesystem::exists(arguments.file))
    throw UsageError(fmt::format("{}: no such file", arguments.file.string()));
  catchInterruption();
  if (arguments.png.empty() && isSite(arguments.file)) return showSite(arguments);
  if (!arguments.png.empty()) return draw(arguments);
  if (arguments.web.given() || arguments.ros2.given() || (isRecording(arguments.file) && !arguments.scan))
    return play(arguments);
  return show(sceneOf(arguments).finished(), arguments);
}

std::function<int()> addViewOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ViewArguments>();
  addOption(app, "file", arguments->file,
            "a capture, bag, rawlog or folder of clouds to play; a folder of `site`; a map (.simplemap, .bt, .ot), a "
            "cloud (.ply, .pcd, .bin of KITTI) or a trajectory (.tum) to show")
      .required();
  addOption(app, "--png", arguments->png, "draw into this picture instead of a window; needs no display")
      .typeName("FILE");
  addWeb(app, arguments->web);
  addRos2(app, arguments->ros2);
  addOption(app, "--trajectory", arguments->trajectory,
            "for a capture or rawlog: poses of the body, by which scans and map are drawn")
      .existingFile();
  addOverwrite(app, arguments->overwrite);
  addOption(app, "--scan", arguments->scan,
            "for a capture or rawlog: show only this scan, counted from 0, instead of playing all [with --png: 0]")
      .typeName("N");
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb viewVerb()
{
  return {"view",
          "plays a recording on a page; shows a map, point cloud or trajectory in a window; or draws a picture",
          {},
          &addViewOptions};
}
}  // namespace scanloom
