/** THE table of lidar families: the only place that knows which decoder a metadata file needs. */
#pragma once
#include "lidar/PacketDecoder.h"

#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct LidarFamily
{
  std::string name;       // "ouster"
  std::string described;  // what its metadata file is, for the error that lists the families
  bool (*recognises)(const std::string& metadata_text);
  std::unique_ptr<PacketDecoder> (*make)(const std::string& metadata_text, const std::string& file_name,
                                         const Rigid& body_T_sensor);
};
const std::vector<LidarFamily>& lidarFamilies();

/**
 * The decoder of the sensor that `metadata_file` describes, points in the body frame.
 * Throws std::invalid_argument if the file can't be read, belongs to no family or is faulty (file, key, what is
 * expected).
 */
std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_file, const Rigid& body_T_sensor);

/** The same from the text; `name` stands for it in errors. */
std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_text, const std::string& name,
                                           const Rigid& body_T_sensor);
}  // namespace scanloom
