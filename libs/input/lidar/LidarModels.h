/** The table of lidar families: the only place that knows which decoder a metadata file needs. */
#pragma once
#include "input/lidar/PacketDecoder.h"

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
 * Names of the built-in models whose packets look like the first one, by size, markers, model and number of returns:
 * "XT32", "XT32 dual"; if the packets, which follow each other, turn at another rate than the model's file has:
 * "VLP-16 1200 rpm". Empty if there are none, several where packets do not tell (an early VLP-16 says that it is an
 * HDL-32E). Takes a millisecond or more: ask once per stream.
 */
std::vector<std::string> modelsThatSend(const std::vector<std::vector<std::uint8_t>>& packets);

/**
 * Of models that are not built in, since every unit has angles of its own: the texts of metadata files that packets
 * like this one need, to be completed by the name of the file with the angles. Two where packets do not tell the number
 * of returns; mostly none.
 */
std::vector<std::string> metadataToComplete(Bytes packet);

/** UDP ports of a sensor's packets. */
struct SensorPorts
{
  std::uint16_t lidar = 0, imu = 0;
};

/** Default ports of a sensor that is asked for its metadata over HTTP: in use until it has answered. */
SensorPorts defaultPorts();
}  // namespace scanloom
