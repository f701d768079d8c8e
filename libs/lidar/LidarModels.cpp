#include "lidar/LidarModels.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lidar/MetadataKeys.h"
#include "lidar/OusterDecoder.h"
#include "lidar/VelodyneDecoder.h"

namespace scanloom
{
namespace
{
std::unique_ptr<PacketDecoder> makeOuster(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<OusterDecoder>(parseOusterMetadata(text, name), body_T_sensor);
}

/** Any JSON object, if no other family took it: what it lacks is said by the parser, key by key. */
bool looksLikeOuster(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

std::unique_ptr<PacketDecoder> makeVelodyne(const std::string& text, const std::string& name,
                                            const Rigid& body_T_sensor)
{
  return std::make_unique<VelodyneDecoder>(parseVelodyneMetadata(text, name), body_T_sensor);
}
}  // namespace

const std::vector<LidarFamily>& lidarFamilies()
{
  static const std::vector<LidarFamily> families{
      // The first that recognises a file has it; Ouster's says nothing of its maker, so it comes last.
      {"velodyne", "a JSON file that begins with \"lidar\": \"velodyne\" (params/lidars/)", &looksLikeVelodyne,
       &makeVelodyne},
      {"ouster", "the JSON text of an Ouster sensor's metadata", &looksLikeOuster, &makeOuster},
  };
  return families;
}

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_file, const Rigid& body_T_sensor)
{
  return makeDecoder(readMetadataText(metadata_file), metadata_file, body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_text, const std::string& name,
                                           const Rigid& body_T_sensor)
{
  std::string expected;
  for (const LidarFamily& family : lidarFamilies())
  {
    if (family.recognises(metadata_text)) return family.make(metadata_text, name, body_T_sensor);
    expected += fmt::format("{}{}", expected.empty() ? "" : ", or ", family.described);
  }
  throw std::invalid_argument(fmt::format("{}: belongs to no known lidar; expected {}", name, expected));
}
}  // namespace scanloom
