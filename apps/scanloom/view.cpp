/** `scanloom view`: a look at a file, in a window or as a picture. */
#include "Arguments.h"
#include "Interruption.h"
#include "Verb.h"
#include "cloud/CloudFile.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "dataset/CloudObservation.h"
#include "mrpt_bridge/ObservationReader.h"
#include "output/OctoMapFile.h"
#include "output/SceneFile.h"
#include "output/SimpleMapReader.h"
#include "output/TrajectoryFile.h"
#include "output/TrajectoryReader.h"

#include <fmt/format.h>
#include <mrpt/gui/CDisplayWindow3D.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

struct ViewArguments
{
  Path file, png;
  std::uint64_t scan = 0;
  int width = 1280, height = 960;
  bool overwrite = false;
};

void addScan(SceneBuilder& scene, const Path& path, std::uint64_t wanted)
{
  ObservationReader reader(path);
  std::uint64_t clouds = 0;
  while (const ObservationPtr observation = reader.next())
    if (const auto cloud = cloudIn(observation); cloud && clouds++ == wanted)
      return scene.addPoints(positionsInBody(*cloud));
  const std::string damage = reader.damage().empty() ? "" : fmt::format(", and is damaged: {}", reader.damage());
  throw std::runtime_error(fmt::format("{}: has {} clouds, no number {}{}", path.string(), clouds, wanted, damage));
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

SceneBuilder sceneOf(const ViewArguments& arguments)
{
  SceneBuilder scene;
  const std::string ending = arguments.file.extension().string();
  if (ending == ".rawlog")
    addScan(scene, arguments.file, arguments.scan);
  else if (ending == ".simplemap")
    addKeyframes(scene, arguments.file);
  else if (ending == ".bt" || ending == ".ot")
    scene.addOccupied(*readOctoMap(arguments.file));
  else if (isTrajectoryName(arguments.file))
    scene.addPath(readTrajectory(arguments.file));
  else if (ending == ".ply" || ending == ".pcd" || ending == ".bin" || ending == ".gz")
    scene.addPoints(readCloud(arguments.file).points);
  else
    throw UsageError(
        fmt::format("{}: can be shown are .rawlog, .simplemap, .bt, .ot, .ply, .pcd, .bin and trajectories",
                    arguments.file.string()));
  return scene;
}

int show(const mrpt::opengl::COpenGLScene::Ptr& scene, const ViewArguments& arguments)
{
  using namespace std::chrono_literals;
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
    throw std::runtime_error("there is no display: --png FILE draws a picture without one");
  mrpt::gui::CDisplayWindow3D window(arguments.file.filename().string(), static_cast<unsigned>(arguments.width),
                                     static_cast<unsigned>(arguments.height));
  const mrpt::opengl::CCamera camera = scene->getViewport()->getCamera();
  window.get3DSceneAndLock() = scene;
  window.unlockAccess3DScene();
  window.setCameraPointingToPoint(camera.getPointingAtX(), camera.getPointingAtY(), camera.getPointingAtZ());
  window.setCameraZoom(camera.getZoomDistance());
  window.setCameraAzimuthDeg(camera.getAzimuthDegrees());
  window.setCameraElevationDeg(camera.getElevationDegrees());
  window.repaint();
  while (window.isOpen() && !window.keyHit() && !interrupted()) std::this_thread::sleep_for(50ms);
  return interrupted() ? kInterrupted : kDone;
}

int run(const ViewArguments& arguments)
{
  if (!arguments.png.empty())
  {
    if (arguments.png.extension() != ".png")
      throw UsageError(fmt::format("--png {}: the name must end in .png", arguments.png.string()));
    refuseExisting({arguments.png}, arguments.overwrite);
  }
  catchInterruption();
  const auto scene = sceneOf(arguments).finished();
  if (arguments.png.empty()) return show(scene, arguments);
  writePicture(arguments.png, *scene, arguments.width, arguments.height);
  fmt::print("{}\n", arguments.png.string());
  return kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ViewArguments>();
  app.add_option("file", arguments->file, "a .rawlog, .simplemap, .bt, .ot, .ply, .pcd, .bin (KITTI) or .tum")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--png", arguments->png, "a picture in place of a window; needs no display")->type_name("FILE");
  addOverwrite(app, arguments->overwrite);
  app.add_option("--scan", arguments->scan, "of a rawlog: which cloud, from 0")->capture_default_str()->type_name("N");
  app.add_option("--width", arguments->width, "in pixels")->check(CLI::Range(64, 8192))->capture_default_str();
  app.add_option("--height", arguments->height, "in pixels")->check(CLI::Range(64, 8192))->capture_default_str();
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb viewVerb()
{
  return {"view", "a look at a rawlog, map, cloud or trajectory, with or without a display", {}, &addOptions};
}
}  // namespace scanloom
