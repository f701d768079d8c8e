#include "mrpt/edit/internal/KeepLidars.h"

#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/observations/PointSelection.h"
#include "mrpt/observations/RawlogReader.h"

#include <optional>

namespace scanloom
{
namespace
{
using mrpt::obs::CObservationPointCloud;
using NewId = std::optional<std::uint8_t>;

class LidarFilter
{
 public:
  LidarFilter(const std::vector<std::string>& names, RecordingHeader header)
    : all_(std::move(header)), kept_(all_), new_id_(all_.lidars.size())
  {
    kept_.lidars.clear();
    for (const std::string& name : names) new_id_[lidarNamed(name, all_)] = std::uint8_t{0};
    for (std::size_t i = 0; i < new_id_.size(); ++i)
      if (new_id_[i])
      {
        new_id_[i] = static_cast<std::uint8_t>(kept_.lidars.size());
        kept_.lidars.push_back(all_.lidars[i]);
      }
  }

  Observations operator()(const ObservationPtr& observation) const
  {
    if (!observation) return {};
    if (headerIn(*observation)) return {withHeader(*observation, kept_)};
    const auto part = partOf(observation->sensorLabel, all_);
    if (part && !new_id_[part->lidar]) return {};
    const auto cloud = cloudIn(observation);
    return {cloud ? filtered(*cloud) : observation};
  }

 private:
  ObservationPtr filtered(const CObservationPointCloud& cloud) const
  {
    const std::vector<std::uint8_t> ids = sensorIdsOf(cloud, all_);
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (new_id_[ids[i]]) points.push_back(static_cast<std::uint32_t>(i));
    const auto map = selected(genericCloudOf(cloud), points);
    auto& sensor_id = *map->getPointsBufferRef_uint8_field("sensor_id");
    for (std::size_t k = 0; k < points.size(); ++k) sensor_id[k] = *new_id_[ids[points[k]]];
    return withPoints(cloud, map);
  }

  RecordingHeader all_, kept_;
  std::vector<NewId> new_id_;  // by the sensor_id of the input
};
}  // namespace

RawlogOperation keepLidars(const std::vector<std::string>& names, const RecordingHeader& header)
{
  return LidarFilter(names, header);
}
}  // namespace scanloom
