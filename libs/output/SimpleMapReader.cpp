#include "output/SimpleMapReader.h"

#include "mrpt_bridge/Conversions.h"
#include "mrpt_bridge/registerClasses.h"

#include <fmt/format.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
namespace
{
using mrpt::obs::CObservationPointCloud;

constexpr float kFullReflectivity = 255.0F;
constexpr double kSamePose = 1e-6;

void forEachCloud(const mrpt::obs::CSensoryFrame& frame, const std::function<void(CObservationPointCloud&)>& visit)
{
  for (const auto& observation : frame)
    if (auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(observation); cloud)
      if (cloud->load(); cloud->pointcloud) visit(*cloud);
}

auto lidarNamed(const std::string& name, const std::vector<MountedLidar>& lidars)
{
  return std::find_if(lidars.begin(), lidars.end(), [&](const MountedLidar& lidar) { return lidar.name == name; });
}

void append(PointCloud& points, const CObservationPointCloud& cloud, const Rigid& body_T_sensor, std::size_t lidar)
{
  const auto* with_intensity = dynamic_cast<const mrpt::maps::CPointsMapXYZI*>(cloud.pointcloud.get());
  const std::size_t first = points.size(), added = cloud.pointcloud->size();
  points.resize(first + added);
  for (std::size_t i = 0; i < added; ++i)
  {
    Eigen::Vector3f p;
    cloud.pointcloud->getPointFast(i, p.x(), p.y(), p.z());
    p = (body_T_sensor * p.cast<double>().eval()).cast<float>();
    points.x[first + i] = p.x();
    points.y[first + i] = p.y();
    points.z[first + i] = p.z();
    if (with_intensity)
      points.intensity[first + i] = static_cast<std::uint8_t>(std::clamp(
          std::round(with_intensity->getPointIntensity_fast(i) * kFullReflectivity), 0.0F, kFullReflectivity));
    points.sensor_id[first + i] = static_cast<std::uint8_t>(lidar);
  }
}
}  // namespace

SimpleMapReader::SimpleMapReader(const std::filesystem::path& path) : map_(std::make_unique<mrpt::maps::CSimpleMap>())
{
  registerClasses();
  const auto refused = [&](const std::string& why)
  { return std::runtime_error(fmt::format("{}: {}", path.string(), why)); };
  if (!map_->loadFromFile(path.string())) throw refused("is no .simplemap, or cut short");

  for (const auto& pair : *map_)
    forEachCloud(*pair.sf,
                 [&](const CObservationPointCloud& cloud)
                 {
                   const Rigid body_T_sensor = fromMrpt(cloud.sensorPose);
                   const auto known = lidarNamed(cloud.sensorLabel, lidars_);
                   if (known == lidars_.end())
                     lidars_.push_back({cloud.sensorLabel, body_T_sensor});
                   else if (boxMinus(body_T_sensor, known->body_T_sensor).norm() > kSamePose)
                     throw refused(fmt::format("lidar '{}' has different poses on the body", cloud.sensorLabel));
                 });
  if (lidars_.empty()) throw refused("holds no point cloud");
  if (lidars_.size() > 256) throw refused(fmt::format("{} lidars: 256 are the most", lidars_.size()));
}

SimpleMapReader::~SimpleMapReader() = default;

std::size_t SimpleMapReader::size() const { return map_->size(); }

Keyframe SimpleMapReader::keyframe(std::size_t index) const
{
  const auto& pair = *std::next(map_->begin(), static_cast<std::ptrdiff_t>(index));
  Keyframe keyframe;
  keyframe.map_T_body = fromMrpt(pair.pose->getMeanVal());
  forEachCloud(*pair.sf,
               [&](const CObservationPointCloud& cloud)
               {
                 keyframe.stamp = fromMrpt(cloud.timestamp);
                 const auto lidar = lidarNamed(cloud.sensorLabel, lidars_);
                 append(keyframe.points, cloud, lidar->body_T_sensor,
                        static_cast<std::size_t>(lidar - lidars_.begin()));
               });
  return keyframe;
}
}  // namespace scanloom
