#include "mrpt/maps/OctoMapExport.h"

#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/internal/RayInsertion.h"

#include <fmt/format.h>
#include <octomap/octomap.h>

#include <array>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct Preset
{
  const char* name;
  OctoMapOptions options;
};

constexpr std::array kPresets{
    Preset{"preview", {0.2, 30.0}},
    Preset{"inventory", {0.1, 20.0}},
    Preset{"fine", {0.05, 15.0}},
};

octomap::point3d toOctomap(const Eigen::Vector3d& p)
{
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/** The points by the lidar that measured them, in the map frame. */
std::vector<octomap::Pointcloud> splitByLidar(const Keyframe& keyframe, std::size_t lidars)
{
  std::vector<octomap::Pointcloud> clouds(lidars);
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
  {
    const std::uint8_t lidar = keyframe.points.sensor_id[i];
    if (lidar >= lidars)
      throw std::invalid_argument(
          fmt::format("OctoMap: a point has sensor_id = {}, but only {} lidars have a pose", lidar, lidars));
    clouds[lidar].push_back(toOctomap(keyframe.map_T_body * keyframe.points.position(i).cast<double>().eval()));
  }
  return clouds;
}
/** The points whose rays may pass the area. */
octomap::Pointcloud through(const MapArea& area, const octomap::Pointcloud& points, const octomap::point3d& origin,
                            double max_range)
{
  octomap::Pointcloud passing;
  for (const octomap::point3d& point : points)
  {
    const octomap::point3d ray = point - origin;
    const double reach = std::min(1.0, max_range / std::max<double>(ray.norm(), 1e-6));
    bool passes = true;
    for (unsigned axis = 0; axis < 2; ++axis)
    {
      const double a = origin(axis), b = a + reach * ray(axis), least = area.least[axis];
      passes &= std::max(a, b) >= least && std::min(a, b) <= least + area.edge;
    }
    if (passes) passing.push_back(point);
  }
  return passing;
}
}  // namespace

OctoMapOptions octoMapPreset(const std::string& name)
{
  for (const Preset& preset : kPresets)
    if (name == preset.name) return preset.options;
  throw std::invalid_argument(fmt::format("OctoMap preset '{}' is unknown: preview, inventory or fine", name));
}

OctoMapBuilder::OctoMapBuilder(const OctoMapOptions& options, std::vector<Rigid> body_T_sensor,
                               const std::optional<MapArea>& area)
  : options_(options),
    body_T_sensor_(std::move(body_T_sensor)),
    area_(area),
    tree_(std::make_unique<octomap::OcTree>(options.resolution))
{
}

OctoMapBuilder::~OctoMapBuilder() = default;

void OctoMapBuilder::add(const Keyframe& keyframe)
{
  const std::vector<octomap::Pointcloud> clouds = splitByLidar(keyframe, body_T_sensor_.size());
  for (std::size_t lidar = 0; lidar < clouds.size(); ++lidar)
  {
    const Rigid map_T_sensor = keyframe.map_T_body * body_T_sensor_[lidar];
    for (const octomap::point3d& point : clouds[lidar])
      if (octomap::OcTreeKey key; !tree_->coordToKeyChecked(point, key)) ++left_out_;
    const octomap::point3d origin = toOctomap(map_T_sensor.translation);
    const octomap::Pointcloud& cloud =
        area_ ? through(*area_, clouds[lidar], origin, options_.max_range) : clouds[lidar];
    insertRays(*tree_, cloud, origin, options_.max_range, area_);
  }
}

void OctoMapBuilder::write(const std::filesystem::path& binary, const std::filesystem::path& full) &&
{
  tree_->updateInnerOccupancy();
  tree_->prune();
  if (!full.empty()) writeFullOctoMap(full, *tree_);
  if (!binary.empty()) writeBinaryOctoMap(binary, *tree_);
}
}  // namespace scanloom
