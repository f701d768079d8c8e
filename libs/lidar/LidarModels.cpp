#include "lidar/LidarModels.h"

#include "lidar/BuiltInModels.h"
#include "lidar/CloudDecoder.h"
#include "lidar/HesaiDecoder.h"
#include "lidar/OusterDecoder.h"
#include "lidar/RobosenseDecoder.h"
#include "lidar/VelodyneDecoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct LidarFamily
{
  const char* described;  // what its metadata file is, for the error that lists the families
  bool (*recognises)(const std::string& metadata_text);
  std::unique_ptr<PacketDecoder> (*make)(const std::string& metadata_text, const std::string& file_name,
                                         const Rigid& body_T_sensor);
};

std::unique_ptr<PacketDecoder> makeOuster(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<OusterDecoder>(parseOusterMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeVelodyne(const std::string& text, const std::string& name,
                                            const Rigid& body_T_sensor)
{
  return std::make_unique<VelodyneDecoder>(parseVelodyneMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeHesai(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<HesaiDecoder>(parseHesaiMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeRobosense(const std::string& text, const std::string& name,
                                             const Rigid& body_T_sensor)
{
  return std::make_unique<RobosenseDecoder>(parseRobosenseMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeCloud(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<CloudDecoder>(parseCloudMetadata(text, name), body_T_sensor);
}

const std::array<LidarFamily, 5> kFamilies{{
    {"a JSON file that begins with \"lidar\": \"velodyne\" (params/lidars/)", &looksLikeVelodyne, &makeVelodyne},
    {"a JSON file that begins with \"lidar\": \"hesai\" (params/lidars/)", &looksLikeHesai, &makeHesai},
    {"a JSON file that begins with \"lidar\": \"robosense\" (params/lidars/)", &looksLikeRobosense, &makeRobosense},
    {R"(the text {"lidar": "cloud"} for clouds of a bag)", &looksLikeCloud, &makeCloud},
    {"the JSON text of an Ouster sensor's metadata", &looksLikeOuster, &makeOuster},
}};
}  // namespace

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_file, const Rigid& body_T_sensor)
{
  return makeDecoder(metadataText(metadata_file), metadata_file, body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_text, const std::string& name,
                                           const Rigid& body_T_sensor)
{
  std::string expected;
  for (const LidarFamily& family : kFamilies)
  {
    if (family.recognises(metadata_text)) return family.make(metadata_text, name, body_T_sensor);
    expected += fmt::format("{}{}", expected.empty() ? "" : ", or ", family.described);
  }
  throw std::invalid_argument(fmt::format("{}: belongs to no known lidar; expected {}", name, expected));
}

bool isLidarMetadata(const std::string& text)
{
  return std::any_of(kFamilies.begin(), kFamilies.end(),
                     [&](const LidarFamily& family) { return family.recognises(text); });
}

std::vector<std::string> modelsThatSend(Bytes packet)
{
  std::vector<std::string> names;
  for (const BuiltInModel& model : builtInModels())
  {
    for (const char* returns : {"", " dual"})
    {
      const std::string name = std::string(model.name) + returns;
      try
      {
        if (makeDecoder(*builtInMetadata(name), name, Rigid::identity())->kind(packet) == PacketKind::Lidar)
          names.push_back(name);
      }
      catch (const std::invalid_argument&)  // two returns of this model are not read
      {
      }
    }
  }
  return names;
}

SensorPorts defaultPorts() { return {kOusterLidarPort, kOusterImuPort}; }
}  // namespace scanloom
