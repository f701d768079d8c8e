#include "mrpt/maps/SimpleMapFile.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/GzipArchive.h"
#include "mrpt/observations/readByAll.h"

#include <fmt/format.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** The points of one lidar, in its own frame. */
std::shared_ptr<XyziReadByAll> cloudOf(const PointCloud& points, std::size_t lidar, const Rigid& sensor_T_body)
{
  auto cloud = std::make_shared<XyziReadByAll>();
  cloud->resize(static_cast<std::size_t>(std::count(points.sensor_id.begin(), points.sensor_id.end(), lidar)));
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points.sensor_id[i] != lidar) continue;
    const Eigen::Vector3f p = (sensor_T_body * points.position(i).cast<double>().eval()).cast<float>();
    cloud->setPointFast(next, p.x(), p.y(), p.z());
    cloud->setPointIntensity(next++, static_cast<float>(points.intensity[i]) / kFullIntensity);
  }
  return cloud;
}
}  // namespace

SimpleMapBuilder::SimpleMapBuilder(std::vector<MountedLidar> lidars)
  : lidars_(std::move(lidars)), map_(std::make_unique<SimpleMapReadByAll>())
{
}

SimpleMapBuilder::~SimpleMapBuilder() = default;

void SimpleMapBuilder::add(const Keyframe& keyframe)
{
  for (const std::uint8_t sensor_id : keyframe.points.sensor_id)
    if (sensor_id >= lidars_.size())
      throw std::invalid_argument(fmt::format(
          "keyframes.simplemap: a point has sensor_id = {}, but there are {} lidars", sensor_id, lidars_.size()));

  const auto frame = mrpt::obs::CSensoryFrame::Create();
  for (std::size_t lidar = 0; lidar < lidars_.size(); ++lidar)
  {
    const auto cloud = cloudOf(keyframe.points, lidar, lidars_[lidar].body_T_sensor.inverse());
    if (cloud->empty()) continue;
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->timestamp = toMrpt(keyframe.stamp);
    observation->sensorLabel = lidars_[lidar].name;
    observation->sensorPose = toMrpt(lidars_[lidar].body_T_sensor);
    observation->pointcloud = cloud;
    frame->insert(observation);
  }
  map_->insert(mrpt::poses::CPose3DPDFGaussian::Create(toMrpt(keyframe.map_T_body)), frame);
}

void SimpleMapBuilder::write(const std::filesystem::path& path) const { writeGzip(path, *map_); }
}  // namespace scanloom
