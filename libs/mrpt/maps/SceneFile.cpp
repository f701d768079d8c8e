#include "mrpt/maps/SceneFile.h"

#include "base/core/OutputFile.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/observations/GzipArchive.h"

#include <fmt/format.h>
#include <mrpt/img/CImage.h>
#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CFBORender.h>
#include <mrpt/version.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Box = Eigen::AlignedBox3f;

constexpr float kFarthestDrawn = 1e7F;  // m

/** The range of the colours: quantiles, so that a few outliers do not stretch it. */
struct Heights
{
  float low, high;
};

Heights heightsOf(const std::vector<Eigen::Vector3f>& points)
{
  std::vector<float> z(points.size());
  std::transform(points.begin(), points.end(), z.begin(), [](const Eigen::Vector3f& p) { return p.z(); });
  const auto quantile = [&](double share)
  {
    const auto nth = z.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(z.size() - 1));
    std::nth_element(z.begin(), nth, z.end());
    return *nth;
  };
  return {quantile(0.01), quantile(0.99)};
}

viz::CPointCloudColoured::Ptr cloudOf(const std::vector<Eigen::Vector3f>& points)
{
  constexpr float kPointSize = 2.0F;  // pixels
  constexpr float kDarkest = 0.2F;    // the map of colours begins with blue too dark for the background
  const Heights heights = heightsOf(points);
  const float span = std::max(0.5F, heights.high - heights.low);
  auto cloud = viz::CPointCloudColoured::Create();
  cloud->setPointSize(kPointSize);
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& p : points)
  {
    const float share = std::clamp((p.z() - heights.low) / span, 0.0F, 1.0F) * (1 - kDarkest) + kDarkest;
    const mrpt::img::TColorf color(mrpt::img::colormap(mrpt::img::cmJET, share));
    cloud->push_back(p.x(), p.y(), p.z(), color.R, color.G, color.B);
  }
  return cloud;
}

viz::CSetOfLines::Ptr lineOf(const Trajectory& path)
{
  auto lines = viz::CSetOfLines::Create();
  lines->setColor_u8(0xFF, 0xFF, 0xFF);
  lines->setLineWidth(3);
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    const Eigen::Vector3d &from = path[i - 1].map_T_body.translation, &to = path[i].map_T_body.translation;
    lines->appendLine(from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
  }
  return lines;
}

viz::CGridPlaneXY::Ptr gridBelow(const Box& box)
{
  constexpr float kStep = 10;
  constexpr float kMostLines = 1000;  // along an axis; MRPT makes them one by one
  float step = kStep;
  while (box.sizes().head<2>().maxCoeff() > kMostLines * step) step *= 10;
  const auto down = [step](float value) { return step * std::floor(value / step); };
  auto grid = viz::CGridPlaneXY::Create(down(box.min().x()), down(box.max().x()) + step, down(box.min().y()),
                                        down(box.max().y()) + step, box.min().z(), step);
  grid->setColor_u8(0x60, 0x60, 0x60);
  return grid;
}

/** Without outliers, which would move the camera far away, and within what floats can still tell apart to a metre. */
Box boxOf(const std::vector<Eigen::Vector3f>& points, const std::vector<Trajectory>& paths)
{
  constexpr std::size_t kStride = 50;
  constexpr double kStrays = 0.02;
  Box box;
  for (Eigen::Index axis = 0; axis < 3 && !points.empty(); ++axis)
  {
    std::vector<float> sample;
    for (std::size_t i = 0; i < points.size(); i += kStride) sample.push_back(points[i][axis]);
    std::sort(sample.begin(), sample.end());
    const auto cut = static_cast<std::size_t>(kStrays * static_cast<double>(sample.size()));
    if (axis == 0) box = Box(points.front(), points.front());
    box.min()[axis] = sample[cut];
    box.max()[axis] = sample[sample.size() - 1 - cut];
  }
  for (const Trajectory& path : paths)
    for (const StampedPose& pose : path) box.extend(pose.map_T_body.translation.cast<float>().eval());
  if (box.isEmpty()) return box;
  const auto near = [](const Eigen::Vector3f& corner)
  { return corner.cwiseMax(-kFarthestDrawn).cwiseMin(kFarthestDrawn).eval(); };
  return {near(box.min()), near(box.max())};
}

void aimCamera(MrptScene& scene, const Box& box)
{
  constexpr float kAzimuth = -60, kElevation = 45;  // degrees
  const float size = std::max(4.0F, box.diagonal().norm());
  const auto view = scene.getViewport();
  viz::CCamera& camera = view->getCamera();
  camera.setPointingAt(box.center().x(), box.center().y(), box.center().z());
  camera.setZoomDistance(1.5F * size);
  camera.setAzimuthDegrees(kAzimuth);
  camera.setElevationDegrees(kElevation);
  view->setViewportClipDistances(0.05F, 10 * size);
  view->setCustomBackgroundColor({0.10F, 0.11F, 0.12F});
}
}  // namespace

void SceneBuilder::addPoints(const std::vector<Eigen::Vector3f>& points)
{
  std::copy_if(points.begin(), points.end(), std::back_inserter(points_),
               [](const Eigen::Vector3f& point) { return point.allFinite(); });
}

void SceneBuilder::addKeyframe(const Keyframe& keyframe)
{
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
    points_.push_back((keyframe.map_T_body * keyframe.points.position(i).cast<double>().eval()).cast<float>());
}

void SceneBuilder::addOccupied(const octomap::OcTree& tree)
{
  forEachOccupiedVoxel(
      tree, [this](const octomap::point3d& centre) { points_.emplace_back(centre.x(), centre.y(), centre.z()); });
}

void SceneBuilder::addPath(const Trajectory& path) { paths_.push_back(path); }

MrptScene::Ptr SceneBuilder::finished() const
{
  const Box box = boxOf(points_, paths_);
  if (box.isEmpty()) throw std::invalid_argument("there is nothing to see: no points and no poses");
  auto scene = MrptScene::Create();
  scene->insert(gridBelow(box));
  scene->insert(viz::stock_objects::CornerXYZSimple(2.0F, 3.0F));
  if (!points_.empty()) scene->insert(cloudOf(points_));
  for (const Trajectory& path : paths_) scene->insert(lineOf(path));
  aimCamera(*scene, box);
  return scene;
}

void writeScene(const std::filesystem::path& path, const MrptScene& scene) { writeGzip(path, scene); }

void writePicture(const std::filesystem::path& path, const MrptScene& scene, int width, int height)
{
  mrpt::opengl::CFBORender renderer(static_cast<unsigned>(width), static_cast<unsigned>(height));
#if MRPT_VERSION >= 0x030000
  renderer.setCamera(scene.getViewport()->getCamera());
#else
  renderer.getCamera(scene) = scene.getViewport()->getCamera();
#endif
  mrpt::img::CImage image;
  renderer.render_RGB(scene, image);
  OutputFile file(path);
  if (!image.saveToFile(file.temporary().string()))
    throw std::runtime_error(fmt::format("cannot write the picture '{}'", path.string()));
  file.commit();
}
}  // namespace scanloom
