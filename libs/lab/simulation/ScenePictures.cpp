#include "lab/simulation/ScenePictures.h"

#include "base/formats/Canvas.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
const Color kSky{0.87F, 0.92F, 0.97F}, kPaper{0.98F, 0.98F, 0.97F}, kNothing{0.86F, 0.86F, 0.86F},
    kInk{0.15F, 0.16F, 0.18F};
constexpr int kWidth = 1200;

Color colorOf(Surface surface)
{
  switch (surface)
  {
    case Surface::Ground:
      return {0.62F, 0.53F, 0.38F};
    case Surface::Stem:
      return {0.55F, 0.33F, 0.20F};
    case Surface::Branch:
      return {0.40F, 0.27F, 0.18F};
    case Surface::Crown:
      return {0.24F, 0.50F, 0.24F};
    case Surface::Undergrowth:
      return {0.52F, 0.68F, 0.28F};
    case Surface::Machine:
      return {0.95F, 0.70F, 0.15F};
    case Surface::Boom:
      return {0.85F, 0.45F, 0.10F};
    case Surface::Object:
      return {0.75F, 0.15F, 0.25F};
    case Surface::Building:
      return {0.70F, 0.66F, 0.62F};
    case Surface::Precipitation:
      return {0.60F, 0.70F, 0.85F};
  }
  return kInk;
}

/** The colour map viridis, by five of its colours. */
Color colorOfShare(double share)
{
  const std::array<Color, 5> kColors{Color{0.99F, 0.91F, 0.14F}, Color{0.37F, 0.79F, 0.38F}, Color{0.13F, 0.57F, 0.55F},
                                     Color{0.23F, 0.32F, 0.55F}, Color{0.27F, 0.00F, 0.33F}};
  const double place = std::clamp(share, 0.0, 1.0) * (kColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kColors.size() - 2);
  const auto part = static_cast<float>(place - static_cast<double>(below));
  return (1 - part) * kColors[below] + part * kColors[below + 1];
}

/** x to the right, y downwards, z ahead. */
Eigen::Matrix3d lookingAt(const Eigen::Vector3d& ahead)
{
  Eigen::Matrix3d world_R_camera;
  world_R_camera.col(2) = ahead.normalized();
  world_R_camera.col(0) = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  world_R_camera.col(1) = world_R_camera.col(2).cross(world_R_camera.col(0));
  return world_R_camera;
}

constexpr double kFarthest = 80;  // m

Color shaded(const std::optional<Hit>& hit)
{
  if (!hit) return kSky;
  const auto light = static_cast<float>(0.45 + 0.55 * hit->cosine_incidence);
  const auto haze = static_cast<float>(0.8 * hit->range / kFarthest);
  return (1 - haze) * light * colorOf(hit->surface) + haze * kSky;
}

/** Behind the machine, in the body frame; lower where there is a roof. */
Eigen::Vector3d eyeAt(const Moment& moment)
{
  const Eigen::Vector3d outdoors(-11, -3.5, 5.5), indoors(-5, -0.6, 2.2);
  const Ray upwards{moment.worldTBody() * Eigen::Vector3d(0, 0, 1.8), Eigen::Vector3d::UnitZ()};
  const std::optional<Hit> above = moment.cast({upwards, 2 * outdoors.z(), 0});
  return above && above->surface == Surface::Building ? indoors : outdoors;
}

constexpr int kTitle = 26, kLeastRow = 3;

int rowHeight(const OusterMetadata& metadata) { return std::max(kLeastRow, 192 / metadata.channels); }

void drawTurn(const SimulatedLidar& lidar, const Scenery& scenery, std::uint64_t first, int top, double farthest,
              Canvas& canvas)
{
  const int columns = lidar.metadata().columns_per_frame, height = rowHeight(lidar.metadata());
  std::vector<OusterColumn> turn(static_cast<std::size_t>(columns));
  tbb::parallel_for(std::size_t{0}, turn.size(),
                    [&](std::size_t i) { turn[i] = lidar.measure(scenery, first + i).column; });
  const auto pixel = [&](int column) { return column * kWidth / columns; };
  // A beam looks aside of its column's direction; the picture shows directions.
  const auto placeOf = [&](int column, std::size_t beam)
  {
    const double aside = lidar.metadata().beam_azimuth_deg[beam] / 360 * columns;
    return (column + static_cast<int>(std::lround(aside)) + columns) % columns;
  };
  for (const OusterColumn& column : turn)
    for (std::size_t beam = 0; beam < column.readings.size(); ++beam)
    {
      const double range = 1e-3 * column.readings[beam].first.range_mm;
      const int place = placeOf(column.measurement_id, beam);
      const int left = pixel(place), width = pixel(place + 1) - left;
      // Logarithmic, so that decimetres show near by.
      const Color color = range > 0 ? colorOfShare(std::log(range) / std::log(farthest)) : kNothing;
      canvas.fillRectangle(left, top + static_cast<int>(beam) * height, std::max(1, width), height, color);
    }
}
}  // namespace

void drawStand(const Scene& scene, double t, const std::filesystem::path& png)
{
  constexpr int kHeight = 640;
  constexpr double kFocalLength = 0.55 * kWidth;  // pixels
  const Moment moment = scene.scenery.at(t);
  const Eigen::Vector3d eye = moment.worldTBody() * eyeAt(moment);
  const Eigen::Matrix3d world_R_camera = lookingAt(moment.worldTBody() * Eigen::Vector3d(6, 0, 2.5) - eye);
  Canvas canvas(kWidth, kHeight, kSky);
  std::vector<std::vector<std::optional<Hit>>> rows(kHeight);
  tbb::parallel_for(0, kHeight,
                    [&](int y)
                    {
                      std::vector<RayQuery> queries;
                      for (int x = 0; x < kWidth; ++x)
                      {
                        const Eigen::Vector3d in_camera(x - 0.5 * kWidth, y - 0.5 * kHeight, kFocalLength);
                        const auto draw = static_cast<std::uint64_t>(y * kWidth + x);
                        queries.push_back({{eye, (world_R_camera * in_camera).normalized()}, kFarthest, draw});
                      }
                      rows[static_cast<std::size_t>(y)] = moment.cast(queries);
                    });
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      canvas.blend(x, y, shaded(rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]), 1);
  canvas.savePng(png);
}

void drawScans(const Scene& scene, double t, const std::filesystem::path& png)
{
  constexpr double kFarthestShown = 50;  // m
  int height = kTitle;
  for (const LidarStation& station : scene.lidars)
    height += kTitle + rowHeight(station.metadata()) * station.metadata().channels;
  Canvas canvas(kWidth, height, kPaper);
  int top = 0;
  for (const LidarStation& station : scene.lidars)
  {
    const SimulatedLidar& lidar = station.runs.front().lidar;
    const auto per_turn = static_cast<std::uint64_t>(lidar.metadata().columns_per_frame);
    std::uint64_t first = 0;
    while (lidar.instantOf(first).truth < scene.span.start + fromSeconds(t) ||
           lidar.instantOf(first).measurement_id != 0)
      ++first;
    canvas.text(8, top + 6, fmt::format("{}: {} beams, {} columns", station.name, lidar.metadata().channels, per_turn),
                Canvas::Font::Large, kInk);
    drawTurn(lidar, scene.scenery, first, top + kTitle, kFarthestShown, canvas);
    top += kTitle + rowHeight(lidar.metadata()) * lidar.metadata().channels;
  }
  for (int x = 0; x < 200; ++x) canvas.fillRectangle(8 + x, top + 8, 1, 10, colorOfShare(x / 199.0));
  canvas.text(216, top + 6, fmt::format("1 to {} m, logarithmic; grey: no return", kFarthestShown), Canvas::Font::Large,
              kInk);
  canvas.savePng(png);
}
}  // namespace scanloom
