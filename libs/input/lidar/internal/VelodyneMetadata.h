/** The file with model, settings and beam angles of a Velodyne sensor: params/lidars/velodyne_*.json. */
#pragma once
#include "input/lidar/internal/VelodyneModels.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Lists have one value per laser in the order of firing (laser id of the maker's calibration files). */
struct VelodyneMetadata
{
  const VelodyneModel* model = nullptr;  // a row of kVelodyneModels
  std::uint8_t product_id = 0;           // last byte of packets; that of the model unless the file has one
  std::uint8_t early_product_id = 0;     // of packets that turn as set in the sensor; 0: none
  std::string serial;                    // for reports only: packets have none
  double rpm = 600;                      // as set in the sensor
  int returns = 1;                       // as set in the sensor: 1 (strongest or last) or 2
  std::uint16_t lidar_port = 2368;
  double first_azimuth_deg = 0, last_azimuth_deg = 360;  // field of view as set in the sensor, clockwise; may wrap
  std::vector<double> vertical_deg;                      // above the plane of rotation
  std::vector<double> azimuth_offset_deg;                // clockwise, added to the azimuth in the packet
  std::vector<double> vertical_offset_mm;                // of the ray's origin
};

/** Whether this is the text of such a file: a JSON object with "lidar": "velodyne". */
bool looksLikeVelodyne(const std::string& text);

/** Throws std::invalid_argument with `name`, the key and what is expected. */
VelodyneMetadata parseVelodyneMetadata(const std::string& text, const std::string& name);
}  // namespace scanloom
