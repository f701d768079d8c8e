#include "mrpt/maps/SimpleMapReader.h"

#include "base/config/MrptMessage.h"
#include "input/rawlogs/Conversions.h"
#include "input/rawlogs/CountedArchive.h"
#include "mrpt/maps/internal/PoseCovariance.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/registerClasses.h"

#include <fmt/format.h>
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

constexpr double kSamePose = 1e-6;
constexpr double kFarthest = 1e8;  // m, from the origin of a map: any coordinates of a country are nearer

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
  const PointCloud read = pointsIn(*cloud.pointcloud);
  std::size_t next = points.size();
  points.resize(next + read.size());
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    Eigen::Vector3f p = read.position(i);
    if (!p.allFinite()) continue;  // other programs store directions without a return as NaN
    p = (body_T_sensor * p.cast<double>().eval()).cast<float>();
    points.x[next] = p.x();
    points.y[next] = p.y();
    points.z[next] = p.z();
    points.intensity[next] = read.intensity[i];
    points.ring[next] = read.ring[i];
    points.sensor_id[next++] = static_cast<std::uint8_t>(lidar);
  }
  points.resize(next);
}

std::unique_ptr<mrpt::maps::CSimpleMap> load(const std::filesystem::path& path)
{
  registerClasses();
  uncompressedBytes(path);  // throws if the file is cut short or damaged
  CountedArchive archive(path);
  auto map = std::make_unique<mrpt::maps::CSimpleMap>();
  try
  {
    archive >> *map;
  }
  catch (const std::exception&)
  {
    throw std::runtime_error(fmt::format(
        "{}: {}", path.string(), archive.refused().empty() ? "is no .simplemap, or damaged" : archive.refused()));
  }
  return map;
}

const auto& keyframeAt(const mrpt::maps::CSimpleMap& map, std::size_t index)
{
  return *std::next(map.begin(), static_cast<std::ptrdiff_t>(index));
}

Rigid soundPose(const mrpt::poses::CPose3D& pose)
{
  const Eigen::Vector3d t(pose.x(), pose.y(), pose.z());
  if (!t.allFinite() || t.cwiseAbs().maxCoeff() > kFarthest)
    throw std::invalid_argument(
        fmt::format("({:g}, {:g}, {:g}) m: not within {:g} m of the origin", t.x(), t.y(), t.z(), kFarthest));
  return fromMrpt(pose);
}

Rigid poseOf(const std::string& what, const mrpt::poses::CPose3D& pose)
{
  try
  {
    return soundPose(pose);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(fmt::format("impossible pose of the {}: {}", what, error.what()));
  }
}
}  // namespace

bool isSimpleMap(const std::filesystem::path& path)
{
  return (path.extension() == ".gz" ? path.stem() : path).extension() == ".simplemap";
}

SimpleMapReader::SimpleMapReader(const std::filesystem::path& path) : map_(load(path))
{
  std::size_t number = 0;
  try
  {
    for (const auto& pair : *map_)
    {
      if (!pair.pose || !pair.sf) throw std::invalid_argument("has no pose or no observations");
      map_T_body_.push_back(poseOf("body", pair.pose->getMeanVal()));
      forEachCloud(*pair.sf, [&](const CObservationPointCloud& cloud) { addLidarOf(cloud); });
      ++number;
    }
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(
        fmt::format("{}: keyframe {} (from 0): {}", path.string(), number, messageIn(error.what())));
  }
  if (lidars_.empty()) throw std::runtime_error(fmt::format("{}: holds no point cloud", path.string()));
}

SimpleMapReader::~SimpleMapReader() = default;

void SimpleMapReader::addLidarOf(const CObservationPointCloud& cloud)
{
  const std::string& name = cloud.sensorLabel;
  const Rigid body_T_sensor = poseOf(fmt::format("lidar '{}'", name), cloud.sensorPose);
  const auto known = lidarNamed(name, lidars_);
  if (known == lidars_.end())
    lidars_.push_back({name, body_T_sensor});
  else if (boxMinus(body_T_sensor, known->body_T_sensor).norm() > kSamePose)
    throw std::invalid_argument(fmt::format("lidar '{}' has different poses on the body", name));
  if (lidars_.size() > kMostLidars)
    throw std::invalid_argument(fmt::format("'{}' is one lidar too many: {} are the most", name, kMostLidars));
}

std::size_t SimpleMapReader::size() const { return map_->size(); }

Matrix6d SimpleMapReader::covariance(std::size_t index) const
{
  return alongBody(map_T_body_.at(index), keyframeAt(*map_, index).pose->getCovariance().asEigen());
}

Keyframe SimpleMapReader::keyframe(std::size_t index) const
{
  const auto& pair = keyframeAt(*map_, index);
  Keyframe keyframe;
  keyframe.map_T_body = map_T_body_.at(index);
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
