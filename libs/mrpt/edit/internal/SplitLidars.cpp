#include "mrpt/edit/internal/SplitLidars.h"

#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/MergeLidars.h"
#include "mrpt/observations/PointSelection.h"

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using PointIndices = std::vector<std::uint32_t>;

std::vector<PointIndices> pointsByLidar(const std::vector<std::uint8_t>& sensor_ids, std::size_t lidars)
{
  std::vector<PointIndices> points(lidars);
  for (std::size_t i = 0; i < sensor_ids.size(); ++i) points[sensor_ids[i]].push_back(static_cast<std::uint32_t>(i));
  return points;
}

bool mergeIsExact(const std::vector<CGenericPointsMap::Ptr>& parts, const std::vector<PointIndices>& points)
{
  PointIndices original;  // index before the split, one part after another
  for (const PointIndices& of_lidar : points) original.insert(original.end(), of_lidar.begin(), of_lidar.end());
  const PointIndices order = mergeOrder(parts);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (original[order[i]] != i) return false;
  return true;
}

void addOrder(CGenericPointsMap& part, const PointIndices& points)
{
  part.registerField_double(kOrderField);
  auto& order = *part.getPointsBufferRef_double_field(kOrderField);
  for (std::size_t k = 0; k < points.size(); ++k) order[k] = points[k];
}
}  // namespace

RawlogOperation splitLidars(const RecordingHeader& header)
{
  return onClouds(
      [header](const CloudPtr& cloud)
      {
        const auto points = pointsByLidar(sensorIdsOf(*cloud, header), header.lidars.size());
        std::vector<CGenericPointsMap::Ptr> parts;
        for (const PointIndices& of_lidar : points) parts.push_back(selected(genericCloudOf(*cloud), of_lidar));
        if (!mergeIsExact(parts, points))
          for (std::size_t i = 0; i < parts.size(); ++i) addOrder(*parts[i], points[i]);

        Observations results;
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
          results.push_back(withPoints(*cloud, parts[i]));
          results.back()->sensorLabel = labelOfPart(cloud->sensorLabel, header.lidars[i].name);
        }
        return results;
      });
}
}  // namespace scanloom
