#include "input/rig/internal/RigSensor.h"

#include "base/core/ConfigError.h"
#include "input/lidar/LidarModels.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
std::uint16_t portOf(int configured, const PacketDecoder* decoder, std::uint16_t LidarDescription::*named,
                     std::uint16_t usual)
{
  if (configured != 0) return static_cast<std::uint16_t>(configured);
  return decoder ? decoder->description().*named : usual;
}
}  // namespace

std::shared_ptr<const PacketDecoder> decoderOf(const RigSensor& lidar)
{
  if (!lidar.metadata) return nullptr;
  return makeDecoder(lidar.metadata->text, lidar.metadata->name, lidar.body_T_sensor);
}

LidarAddress addressOf(const RigSensor& lidar, const PacketDecoder* decoder)
{
  LidarAddress address;
  address.key = lidar.key;
  address.topic = lidar.options.topic;
  address.imu_topic = lidar.options.imu_topic;
  if (!address.topic.empty()) return address;
  address.lidar_port = portOf(lidar.options.port, decoder, &LidarDescription::lidar_port, defaultPorts().lidar);
  address.imu_port = portOf(lidar.options.imu_port, decoder, &LidarDescription::imu_port, defaultPorts().imu);
  if (const auto sensor = sensorOf(lidar.options)) address.source = sensor->address.ip;
  if (address.lidar_port == 0)
    throw ConfigError(
        fmt::format("lidar '{}': {} names no UDP port: give its key 'port'", lidar.options.name, lidar.metadata->name));
  return address;
}

void askForMetadata(std::vector<RigSensor>& lidars, MetadataNeed need)
{
  std::vector<RigSensor*> asked;
  std::vector<LidarOptions> options;
  for (RigSensor& lidar : lidars)
  {
    if (lidar.metadata) continue;
    asked.push_back(&lidar);
    options.push_back(lidar.options);
  }
  const std::vector<MetadataAnswer> answers = metadataOf(options);

  std::vector<std::string> failures;
  bool any_is_coming = asked.size() < lidars.size();
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    RigSensor& lidar = *asked[i];
    lidar.sensor = answers[i].sensor;
    lidar.metadata = answers[i].metadata;
    any_is_coming |= answers[i].metadata || answers[i].failure->fault == SensorFault::NotRunning;
    if (!answers[i].failure) continue;
    lidar.failure = answers[i].failure->what();
    failures.push_back(fmt::format("lidar '{}': {}", lidar.options.name, lidar.failure));
  }
  if (!failures.empty() && (need == MetadataNeed::OfAll || !any_is_coming)) throw ConfigError(failures);
}
}  // namespace scanloom
