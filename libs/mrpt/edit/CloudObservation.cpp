#include "mrpt/edit/CloudObservation.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/PointSelection.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
using mrpt::maps::CGenericPointsMap;
using mrpt::obs::CObservationPointCloud;

CloudPtr cloudIn(const ObservationPtr& observation)
{
  auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(observation);
  if (cloud) cloud->load();
  return cloud && cloud->pointcloud ? cloud : nullptr;
}

RawlogOperation onClouds(std::function<Observations(const CloudPtr&)> change)
{
  return [change = std::move(change)](const ObservationPtr& observation)
  {
    if (!observation) return Observations{};
    const CloudPtr cloud = cloudIn(observation);
    return cloud ? change(cloud) : Observations{observation};
  };
}

RawlogOperation keepingPoints(std::function<std::vector<std::uint8_t>(const CObservationPointCloud&)> marks)
{
  return onClouds([marks = std::move(marks)](const CloudPtr& cloud)
                  { return Observations{withPoints(*cloud, kept(cloud->pointcloud, marks(*cloud)))}; });
}

const CGenericPointsMap& genericCloudOf(const CObservationPointCloud& cloud)
{
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(cloud.pointcloud.get());
  if (!generic)
    throw std::invalid_argument(
        fmt::format("cloud '{}' is of class {}, which has neither point times nor sensor ids: this operation needs "
                    "clouds recorded as CGenericPointsMap",
                    cloud.sensorLabel, cloud.pointcloud->GetRuntimeClass()->className));
  return *generic;
}

void requireTimes(const CObservationPointCloud& cloud)
{
  if (!genericCloudOf(cloud).getPointsBufferRef_float_field("t"))
    throw std::invalid_argument(fmt::format("cloud '{}' has no field t: its points have no times", cloud.sensorLabel));
}

std::vector<std::uint8_t> sensorIdsOf(const CObservationPointCloud& cloud, const RecordingHeader& header)
{
  const auto* ids = genericCloudOf(cloud).getPointsBufferRef_uint8_field("sensor_id");
  if (!ids)
    throw std::invalid_argument(
        fmt::format("cloud '{}' has no field sensor_id: which lidar measured a point is unknown", cloud.sensorLabel));
  const auto unknown =
      std::find_if(ids->begin(), ids->end(), [&](std::uint8_t id) { return id >= header.lidars.size(); });
  if (unknown != ids->end())
    throw std::invalid_argument(fmt::format("cloud '{}' has points of sensor_id {}, but the header has {} lidars",
                                            cloud.sensorLabel, *unknown, header.lidars.size()));
  return {ids->begin(), ids->end()};
}

std::vector<Eigen::Vector3f> positionsInBody(const CObservationPointCloud& cloud)
{
  const Eigen::Isometry3f body_T_cloud(fromMrpt(cloud.sensorPose).matrix().cast<float>());
  const bool in_body_frame = body_T_cloud.matrix().isIdentity(0);
  std::vector<Eigen::Vector3f> positions(cloud.pointcloud->size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    Eigen::Vector3f& p = positions[i];
    cloud.pointcloud->getPointFast(i, p.x(), p.y(), p.z());
    if (!in_body_frame) p = body_T_cloud * p;
  }
  return positions;
}

CloudPtr withPoints(const CObservationPointCloud& cloud, mrpt::maps::CPointsMap::Ptr points)
{
  auto observation = CObservationPointCloud::Create();
  observation->sensorLabel = cloud.sensorLabel;
  observation->timestamp = cloud.timestamp;
  observation->sensorPose = cloud.sensorPose;
  observation->pointcloud = std::move(points);
  return observation;
}

CloudPtr withPositions(const CObservationPointCloud& cloud, const std::vector<Eigen::Vector3f>& positions)
{
  auto result = withPoints(cloud, cloud.pointcloud);
  result->sensorPose = {};
  for (std::size_t i = 0; i < positions.size(); ++i)
    result->pointcloud->setPointFast(i, positions[i].x(), positions[i].y(), positions[i].z());
  result->pointcloud->mark_as_modified();
  return result;
}

CloudPtr withPositions(const CObservationPointCloud& cloud, const PointCloud& points)
{
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < points.size(); ++i) positions.push_back(points.position(i));
  return withPositions(cloud, positions);
}
}  // namespace scanloom
