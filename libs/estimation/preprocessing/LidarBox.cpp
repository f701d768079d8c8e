#include "estimation/preprocessing/LidarBox.h"

#include "base/config/Names.h"
#include "base/config/Values.h"
#include "base/core/ConfigError.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

namespace scanloom
{
namespace
{
LidarBox parseLidarBox(const std::string& text, const std::vector<MountedLidar>& lidars)
{
  std::istringstream words(text);
  std::string name, corners;
  words >> name;
  std::getline(words, corners);
  const std::optional<Eigen::AlignedBox3d> box = parseBox(corners);
  if (!box)
    throw ConfigError(fmt::format(
        "[crop] lidar_boxes: '{}': must be NAME x0 y0 z0 x1 y1 z1 in m, the first corner below the second on each axis",
        text));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    if (lidars[i].name == name) return {static_cast<std::uint8_t>(i), lidars[i].body_T_sensor.inverse(), *box};
    names.push_back(lidars[i].name);
  }
  throw ConfigError(fmt::format("[crop] lidar_boxes: no lidar is called '{}': {}", name, suggestion(name, names)));
}
}  // namespace

std::optional<Eigen::AlignedBox3d> parseBox(const std::string& text)
{
  std::array<double, 6> edges{};
  std::istringstream words(text);
  std::string word;
  for (double& edge : edges)
  {
    const auto number = words >> word ? parseNumber(word) : std::nullopt;
    if (!number) return std::nullopt;
    edge = *number;
  }
  const Eigen::Vector3d low(edges[0], edges[1], edges[2]), high(edges[3], edges[4], edges[5]);
  if (words >> word || !(low.array() < high.array()).all()) return std::nullopt;
  return Eigen::AlignedBox3d(low, high);
}

std::vector<LidarBox> lidarBoxes(const std::string& text, const std::vector<MountedLidar>& lidars)
{
  std::vector<LidarBox> boxes;
  std::istringstream parts(text);
  std::string part;
  while (std::getline(parts, part, ',')) boxes.push_back(parseLidarBox(part, lidars));
  return boxes;
}
}  // namespace scanloom
