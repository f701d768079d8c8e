#include "LiveScene.h"

#include "base/core/Rigid.h"
#include "run/page/LiveExchange.h"

#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/stock_objects.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <array>

namespace scanloom
{
namespace
{
constexpr std::size_t kHead = 8, kPointBytes = 8, kPathBytes = 16;
constexpr std::size_t kOrigin = 8, kMapPoints = 32, kQuaternion = 32, kScanPoints = 64, kPathPoints = 8;

struct Rgb
{
  std::uint8_t r, g, b;
};
// As on the page.
constexpr std::array<Rgb, 8> kLidars{{{10, 124, 255},
                                      {255, 122, 0},
                                      {0, 166, 81},
                                      {212, 0, 200},
                                      {0, 179, 179},
                                      {181, 137, 0},
                                      {127, 95, 255},
                                      {224, 0, 77}}};

Eigen::Vector3d vectorAt(Bytes message, std::size_t at)
{
  return {load<double>(message, at), load<double>(message, at + 8), load<double>(message, at + 16)};
}

/** By height above the machine's own place: stems are as high in a valley as on a hill. */
mrpt::img::TColorf colourOfHeight(float above_body)
{
  constexpr float kLowest = -4, kHighest = 12, kDarkest = 0.2F;  // m; the ramp begins with a blue too dark to see
  const float share = std::clamp((above_body - kLowest) / (kHighest - kLowest), 0.0F, 1.0F);
  return mrpt::img::TColorf(mrpt::img::colormap(mrpt::img::cmJET, kDarkest + share * (1 - kDarkest)));
}

/** Calls visit(from origin in m, lidar) for each point behind `first`. */
template <typename Visit>
void forEachPoint(Bytes message, std::size_t first, const Visit& visit)
{
  constexpr float kCentimetre = 0.01F;
  const std::size_t points = load<std::uint32_t>(message, 4);
  for (std::size_t i = 0; i < points; ++i)
  {
    const std::size_t at = first + i * kPointBytes;
    const Eigen::Vector3f cm(load<std::int16_t>(message, at), load<std::int16_t>(message, at + 2),
                             load<std::int16_t>(message, at + 4));
    visit((kCentimetre * cm).eval(), load<std::uint8_t>(message, at + 7));
  }
}
}  // namespace

LiveScene::LiveScene()
  : scene_(mrpt::opengl::COpenGLScene::Create()),
    scan_(mrpt::opengl::CPointCloudColoured::Create()),
    path_(mrpt::opengl::CSetOfLines::Create()),
    body_(mrpt::opengl::stock_objects::CornerXYZSimple(2.0F, 4.0F))
{
  constexpr float kFar = 200, kStep = 10;
  auto grid = mrpt::opengl::CGridPlaneXY::Create(-kFar, kFar, -kFar, kFar, 0, kStep);
  grid->setColor_u8(0x40, 0x40, 0x40);
  scan_->setPointSize(4);
  path_->setColor_u8(0xC8, 0x00, 0xC8);
  path_->setLineWidth(4);
  scene_->insert(grid);
  scene_->insert(scan_);
  scene_->insert(path_);
  scene_->insert(body_);
  scene_->getViewport()->setCustomBackgroundColor({0.05F, 0.05F, 0.06F});
  scene_->getViewport()->setViewportClipDistances(0.1F, 2000);
}

void LiveScene::apply(Bytes messages)
{
  for (std::size_t at = 0; at < messages.size();)
  {
    const auto kind = load<std::uint32_t>(messages, at);
    const std::size_t bytes = load<std::uint32_t>(messages, at + 4);
    const Bytes message = messages.slice(at + kHead, bytes);
    if (kind == 1) addMap(message);
    if (kind == 2) showScan(message);
    if (kind == 3) extendPath(message);
    at += kHead + bytes;
  }
}

void LiveScene::addMap(Bytes message)
{
  const auto epoch = load<std::uint32_t>(message, 0);
  if (epoch != map_epoch_)
  {
    for (const auto& cloud : map_) scene_->removeObject(cloud);
    map_.clear();
    map_epoch_ = epoch;
  }
  const Eigen::Vector3d origin = vectorAt(message, kOrigin);
  auto cloud = mrpt::opengl::CPointCloudColoured::Create();
  forEachPoint(message, kMapPoints,
               [&](const Eigen::Vector3f& p, std::uint8_t)
               {
                 const mrpt::img::TColorf c = colourOfHeight(p.z());
                 cloud->push_back(p.x(), p.y(), p.z(), c.R, c.G, c.B);
               });
  cloud->setPointSize(2);
  cloud->setLocation(origin.x(), origin.y(), origin.z());
  scene_->insert(cloud);
  map_.push_back(std::move(cloud));
}

void LiveScene::showScan(Bytes message)
{
  const Eigen::Vector3d origin = vectorAt(message, kOrigin);
  position_ = origin.cast<float>();
  scan_->clear();
  forEachPoint(message, kScanPoints,
               [&](const Eigen::Vector3f& p, std::uint8_t lidar)
               {
                 const Rgb c = kLidars[lidar % kLidars.size()];
                 const auto share = [](std::uint8_t value) { return static_cast<float>(value) / 255; };
                 scan_->push_back(p.x(), p.y(), p.z(), share(c.r), share(c.g), share(c.b));
               });
  scan_->setLocation(origin.x(), origin.y(), origin.z());
  Rigid map_T_body;
  map_T_body.translation = origin;
  for (int i = 0; i < 4; ++i)
    map_T_body.rotation.coeffs()[i] = load<double>(message, kQuaternion + 8 * static_cast<std::size_t>(i));
  mrpt::math::CMatrixDouble44 pose;
  pose.asEigen() = map_T_body.matrix();
  body_->setPose(mrpt::poses::CPose3D(pose));
}

void LiveScene::extendPath(Bytes message)
{
  const auto epoch = load<std::uint32_t>(message, 0);
  const std::size_t points = load<std::uint32_t>(message, 4);
  if (epoch != path_epoch_)
  {
    path_->clear();
    path_epoch_ = epoch;
    path_continues_ = false;
  }
  for (std::size_t i = 0; i < points; ++i)
  {
    const std::size_t at = kPathPoints + i * kPathBytes;
    const Eigen::Vector3f p(load<float>(message, at), load<float>(message, at + 4), load<float>(message, at + 8));
    const bool begins = !path_continues_ || load<std::uint32_t>(message, at + 12) == kPathBreak;
    if (!begins) path_->appendLine(path_end_.x(), path_end_.y(), path_end_.z(), p.x(), p.y(), p.z());
    path_end_ = p;
    path_continues_ = true;
  }
}
}  // namespace scanloom
