#include "mrpt/observations/RawlogInfo.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/RawlogReader.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace scanloom
{
namespace
{
using SensorKey = std::tuple<std::string, std::string, std::string>;  // label, class, class of the cloud

RawlogSensor sensorOf(const mrpt::obs::CObservation& observation)
{
  RawlogSensor sensor;
  sensor.label = observation.sensorLabel;
  sensor.observation_class = observation.GetRuntimeClass()->className;
  sensor.count = 1;
  sensor.first = sensor.last = fromMrpt(observation.timestamp);
  const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
  if (cloud && cloud->pointcloud)
  {
    sensor.cloud_class = cloud->pointcloud->GetRuntimeClass()->className;
    sensor.points = cloud->pointcloud->size();
  }
  return sensor;
}

void add(const RawlogSensor& one, RawlogSensor& sum)
{
  if (sum.count == 0)
  {
    sum = one;
    return;
  }
  sum.count += one.count;
  sum.points += one.points;
  sum.first = std::min(sum.first, one.first);
  sum.last = std::max(sum.last, one.last);
}
}  // namespace

std::size_t RawlogInfo::observations() const
{
  return std::accumulate(sensors.begin(), sensors.end(), std::size_t{0},
                         [](std::size_t sum, const RawlogSensor& s) { return sum + s.count; });
}

std::uint64_t RawlogInfo::points() const
{
  return std::accumulate(sensors.begin(), sensors.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const RawlogSensor& s) { return sum + s.points; });
}

Duration RawlogInfo::span() const
{
  if (sensors.empty()) return Duration{0};
  RawlogSensor all;
  for (const RawlogSensor& sensor : sensors) add(sensor, all);
  return all.last - all.first;
}

RawlogInfo rawlogInfo(const std::filesystem::path& path)
{
  RawlogInfo info;
  ObservationReader observations(path);
  info.file_size = std::filesystem::file_size(path);

  std::map<SensorKey, RawlogSensor> sensors;
  bool first = true;
  while (const auto observation = observations.next())
  {
    if (std::exchange(first, false) && (info.header = headerIn(*observation))) continue;
    const RawlogSensor sensor = sensorOf(*observation);
    add(sensor, sensors[{sensor.label, sensor.observation_class, sensor.cloud_class}]);
  }
  for (const auto& [key, sensor] : sensors) info.sensors.push_back(sensor);
  info.damage = observations.damage();
  return info;
}
}  // namespace scanloom
