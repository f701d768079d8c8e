#include "dataset/DeskewClouds.h"

#include "dataset/CloudObservation.h"
#include "mrpt_bridge/Observations.h"
#include "preprocessing/Deskew.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
Scan timedScanOf(const mrpt::obs::CObservationPointCloud& cloud, const std::optional<RecordingHeader>& header)
{
  if (!genericCloudOf(cloud).getPointsBufferRef_float_field("t"))
    throw std::invalid_argument(fmt::format("cloud '{}' has no field t: its points have no times", cloud.sensorLabel));
  return fromObservation(cloud, header);
}

ObservationPtr withPositions(const mrpt::obs::CObservationPointCloud& cloud, const PointCloud& points)
{
  auto result = withPoints(cloud, cloud.pointcloud);
  result->sensorPose = {};
  for (std::size_t i = 0; i < points.size(); ++i)
    result->pointcloud->setPointFast(i, points.x[i], points.y[i], points.z[i]);
  result->pointcloud->mark_as_modified();
  return result;
}

std::optional<PointCloud> deskewed(const mrpt::obs::CObservationPointCloud& cloud, const Trajectory& trajectory,
                                   const std::optional<RecordingHeader>& header)
{
  Scan scan = timedScanOf(cloud, header);
  const auto map_T_start = poseAt(trajectory, scan.start);
  if (!map_T_start) return std::nullopt;
  const Rigid start_T_map = map_T_start->inverse();
  std::vector<Rigid> start_T_column;
  for (const Column& column : scan.columns)
  {
    const auto map_T_column = poseAt(trajectory, column.stamp);
    if (!map_T_column) return std::nullopt;
    start_T_column.push_back(start_T_map * *map_T_column);
  }
  return deskew(std::move(scan), start_T_column);
}

RawlogOperation deskewClouds(const Trajectory& trajectory, const std::optional<RecordingHeader>& header)
{
  return [trajectory, header](const ObservationPtr& observation) -> Observations
  {
    if (!observation) return {};
    const auto cloud = cloudIn(observation);
    if (!cloud) return {observation};
    const auto points = deskewed(*cloud, trajectory, header);
    return points ? Observations{withPositions(*cloud, *points)} : Observations{};
  };
}
}  // namespace scanloom
