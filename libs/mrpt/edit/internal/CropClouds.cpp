#include "mrpt/edit/internal/CropClouds.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"

namespace scanloom
{
namespace
{
using mrpt::obs::CObservationPointCloud;

bool hasSensorIds(const CObservationPointCloud& cloud)
{
  const auto* generic = dynamic_cast<const mrpt::maps::CGenericPointsMap*>(cloud.pointcloud.get());
  return generic && generic->getPointsBufferRef_uint8_field("sensor_id");
}

/** Where the lidar of each point is, in the body frame. */
std::vector<Eigen::Vector3f> originsOf(const CObservationPointCloud& cloud,
                                       const std::optional<RecordingHeader>& header)
{
  const std::size_t size = cloud.pointcloud->size();
  if (!header) return std::vector<Eigen::Vector3f>(size, fromMrpt(cloud.sensorPose).translation.cast<float>());
  if (header->lidars.size() == 1 && !hasSensorIds(cloud))
    return std::vector<Eigen::Vector3f>(size, header->lidars.front().body_T_sensor.translation.cast<float>());

  std::vector<Eigen::Vector3f> origins;
  origins.reserve(size);
  for (const std::uint8_t id : sensorIdsOf(cloud, *header))
    origins.push_back(header->lidars[id].body_T_sensor.translation.cast<float>());
  return origins;
}
}  // namespace

RawlogOperation cropOut(const Eigen::AlignedBox3f& box)
{
  return keepingPoints(
      [box](const CObservationPointCloud& cloud)
      {
        std::vector<std::uint8_t> keep;
        for (const Eigen::Vector3f& p : positionsInBody(cloud)) keep.push_back(!box.contains(p));
        return keep;
      });
}

RawlogOperation limitRanges(const RangeLimits& limits, const std::optional<RecordingHeader>& header)
{
  return keepingPoints(
      [limits, header](const CObservationPointCloud& cloud)
      {
        const auto points = positionsInBody(cloud);
        const auto origins = originsOf(cloud, header);
        std::vector<std::uint8_t> keep(points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const double range = (points[i] - origins[i]).cast<double>().norm();
          keep[i] = range >= limits.least && range <= limits.most;
        }
        return keep;
      });
}
}  // namespace scanloom
