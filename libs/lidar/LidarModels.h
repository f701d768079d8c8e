/** The table of lidar families: the only place that knows which decoder a metadata file needs. */
#pragma once
#include "lidar/PacketDecoder.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The decoder of the sensor that `metadata_file`, a file or the name of a built-in model (BuiltInModels.h), describes;
 * its points are in the body frame. Throws std::invalid_argument if the file cannot be read, belongs to no family, or
 * has a fault (file, key, what is expected).
 */
std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_file, const Rigid& body_T_sensor);

/** The same from the text of the file; errors call it `name`. */
std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_text, const std::string& name,
                                           const Rigid& body_T_sensor);

/** Whether the text looks like a metadata file of one of the families; makeDecoder may still find faults in it. */
bool isLidarMetadata(const std::string& text);

/**
 * Names of the built-in models whose packets look like this one, by size, markers, model and number of returns: "XT32",
 * "XT32 dual". Empty if there are none, several where packets do not tell (an early VLP-16 says that it is an HDL-32E).
 * Takes about a millisecond: ask once per stream.
 */
std::vector<std::string> modelsThatSend(Bytes packet);

/** UDP ports of a sensor's packets. */
struct SensorPorts
{
  std::uint16_t lidar = 0, imu = 0;
};

/** Where a sensor sends by default that tells its metadata over HTTP: needed until it has told them. */
SensorPorts defaultPorts();
}  // namespace scanloom
