#include "input/rig/internal/LidarMetadata.h"

#include "base/core/ConfigError.h"
#include "input/lidar/BuiltInModels.h"
#include "input/packets/OusterHttp.h"
#include "input/packets/SocketAddress.h"

#include <fmt/format.h>

#include <future>

namespace scanloom
{
std::optional<LidarSensor> sensorOf(const LidarOptions& lidar)
{
  if (lidar.address.empty()) return std::nullopt;
  try
  {
    return LidarSensor{SensorAddress::parse(lidar.address), lidar.configure_sensor};
  }
  catch (const std::invalid_argument& problem)
  {
    throw ConfigError(fmt::format("lidar '{}', key 'address': {}", lidar.name, problem.what()));
  }
}

LidarMetadata metadataOf(SensorHttp& http, LidarSensor& sensor)
{
  const std::optional<IpAddress> here = sensor.configure ? ownAddressTowards(sensor.address.ip) : std::nullopt;
  if (here && setOusterDestination(http, *here)) sensor.configure = false;
  return {fetchOusterMetadata(http), "sensor " + sensor.address.text()};
}

MetadataAnswer metadataOf(const LidarOptions& lidar, const SensorHttpLimits& limits)
{
  MetadataAnswer answer;
  if (!lidar.metadata.empty())
  {
    answer.metadata = LidarMetadata{metadataText(lidar.metadata), lidar.metadata};
    return answer;
  }
  answer.sensor = sensorOf(lidar);
  if (!answer.sensor)
    throw ConfigError(fmt::format("lidar '{}' has neither 'metadata' nor 'address': give one", lidar.name));
  try
  {
    SensorHttp http(answer.sensor->address, limits);
    LidarSensor only_asked{answer.sensor->address};
    answer.metadata = metadataOf(http, only_asked);
  }
  catch (const SensorHttpError& failure)
  {
    answer.failure = failure;
  }
  return answer;
}

std::vector<MetadataAnswer> metadataOf(const std::vector<LidarOptions>& lidars, const SensorHttpLimits& limits)
{
  std::vector<std::future<MetadataAnswer>> asked;
  for (const LidarOptions& lidar : lidars)
    asked.push_back(std::async(std::launch::async, [&] { return metadataOf(lidar, limits); }));
  std::vector<MetadataAnswer> answers;
  for (std::future<MetadataAnswer>& answer : asked) answers.push_back(answer.get());
  return answers;
}
}  // namespace scanloom
