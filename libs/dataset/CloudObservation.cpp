#include "dataset/CloudObservation.h"

#include "config/ConfigError.h"
#include "config/Names.h"
#include "mrpt_bridge/Conversions.h"
#include "mrpt_bridge/Observations.h"
#include "mrpt_bridge/RawlogReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using mrpt::obs::CObservationPointCloud;

std::string suffixOf(const std::string& lidar) { return "_" + lidar; }

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

struct SliceLabel
{
  std::string stem, suffix;
};
SliceLabel withoutSliceSuffix(const std::string& label)
{
  if (!endsWith(label, kSliceSuffix)) return {label, ""};
  return {label.substr(0, label.size() - std::strlen(kSliceSuffix)), kSliceSuffix};
}
}  // namespace

CObservationPointCloud::Ptr cloudIn(const ObservationPtr& observation)
{
  auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(observation);
  if (cloud) cloud->load();
  return cloud && cloud->pointcloud ? cloud : nullptr;
}

const CGenericPointsMap& genericCloudOf(const CObservationPointCloud& cloud)
{
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(cloud.pointcloud.get());
  if (!generic)
    throw std::invalid_argument(
        fmt::format("cloud '{}' is of class {}, which holds neither times nor lidars: this "
                    "operation needs clouds recorded as CGenericPointsMap",
                    cloud.sensorLabel, cloud.pointcloud->GetRuntimeClass()->className));
  return *generic;
}

std::vector<std::uint8_t> sensorIdsOf(const CObservationPointCloud& cloud, const RecordingHeader& header)
{
  const auto* ids = genericCloudOf(cloud).getPointsBufferRef_uint8_field("sensor_id");
  if (!ids)
    throw std::invalid_argument(
        fmt::format("cloud '{}' has no field sensor_id: nothing says which lidar saw what", cloud.sensorLabel));
  const auto stranger =
      std::find_if(ids->begin(), ids->end(), [&](std::uint8_t id) { return id >= header.lidars.size(); });
  if (stranger != ids->end())
    throw std::invalid_argument(fmt::format("cloud '{}' has points of sensor_id {}, but the header knows {} lidars",
                                            cloud.sensorLabel, *stranger, header.lidars.size()));
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

CObservationPointCloud::Ptr withPoints(const CObservationPointCloud& cloud, mrpt::maps::CPointsMap::Ptr points)
{
  auto observation = CObservationPointCloud::Create();
  observation->sensorLabel = cloud.sensorLabel;
  observation->timestamp = cloud.timestamp;
  observation->sensorPose = cloud.sensorPose;
  observation->pointcloud = std::move(points);
  return observation;
}

const RecordingHeader& required(const std::optional<RecordingHeader>& header)
{
  if (!header)
    throw std::invalid_argument(
        "the rawlog's first object is not scanloom's header, so nothing is known of its lidars: record it with "
        "scanloom");
  return *header;
}

std::optional<RecordingHeader> headerOf(const std::filesystem::path& path)
{
  const ObservationPtr first = ObservationReader(path).next();
  return first ? headerIn(*first) : std::nullopt;
}

ObservationPtr withHeader(const mrpt::obs::CObservation& comment, const RecordingHeader& header)
{
  const auto changed = toObservation(header, fromMrpt(comment.timestamp));
  changed->sensorLabel = comment.sensorLabel;
  return changed;
}

std::size_t lidarNamed(const std::string& name, const RecordingHeader& header)
{
  std::vector<std::string> names;
  for (const RecordedLidar& lidar : header.lidars) names.push_back(lidar.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UsageError(fmt::format("no lidar of the rawlog is called '{}': {}", name, suggestion(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

std::string labelOfPart(const std::string& whole, const std::string& lidar)
{
  const SliceLabel label = withoutSliceSuffix(whole);
  return label.stem + suffixOf(lidar) + label.suffix;
}

std::optional<LidarPart> partOf(const std::string& label, const RecordingHeader& header)
{
  const SliceLabel parts = withoutSliceSuffix(label);
  std::optional<LidarPart> part;
  std::size_t longest = 0;  // of two lidars 'left' and 'front_left', both fit lidar_front_left
  for (std::size_t i = 0; i < header.lidars.size(); ++i)
  {
    const std::string suffix = suffixOf(header.lidars[i].name);
    if (!endsWith(parts.stem, suffix) || suffix.size() <= longest) continue;
    longest = suffix.size();
    part = LidarPart{parts.stem.substr(0, parts.stem.size() - suffix.size()) + parts.suffix, i};
  }
  return part;
}
}  // namespace scanloom
