#include "mrpt/edit/internal/ConvertClouds.h"

#include "mrpt/edit/CloudObservation.h"

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;

CGenericPointsMap::Ptr positionsAndIntensity(const PointCloud& points)
{
  auto map = CGenericPointsMap::Create();
  map->resize(points.size());
  map->registerField_float("intensity");
  auto& intensity = *map->getPointsBufferRef_float_field("intensity");
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    map->setPointFast(i, points.x[i], points.y[i], points.z[i]);
    intensity[i] = static_cast<float>(points.intensity[i]);
  }
  return map;
}

ObservationPtr asGeneric(const CloudPtr& cloud)
{
  if (std::dynamic_pointer_cast<CGenericPointsMap>(cloud->pointcloud)) return cloud;
  auto converted = withPoints(*cloud, positionsAndIntensity(fromObservation(*cloud, std::nullopt).points));
  converted->sensorPose = {};
  return converted;
}

ObservationPtr asXyzi(const CloudPtr& cloud)
{
  const auto converted =
      toObservation(fromObservation(*cloud, std::nullopt), CloudClass::CPointsMapXYZI, cloud->sensorLabel);
  const bool is_xyzi = cloud->pointcloud->GetRuntimeClass() == converted->pointcloud->GetRuntimeClass();
  return is_xyzi ? cloud : converted;
}
}  // namespace

RawlogOperation convertClouds(CloudClass target)
{
  return onClouds([convert = target == CloudClass::CGenericPointsMap ? asGeneric : asXyzi](const CloudPtr& cloud)
                  { return Observations{convert(cloud)}; });
}
}  // namespace scanloom
