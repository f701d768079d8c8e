/** The file with model, settings and beam angles of a Hesai sensor: params/lidars/hesai_*.json. */
#pragma once
#include "input/lidar/internal/HesaiModels.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Lists have one value per channel, in the order of the packet. */
struct HesaiMetadata
{
  const HesaiModel* model = nullptr;  // a row of kHesaiModels
  std::string serial;                 // for reports only: packets have none
  double rpm = 600;                   // as set in the sensor
  int returns = 1;                    // as set in the sensor: 1 or 2
  std::uint16_t lidar_port = 2368;
  double first_azimuth_deg = 0, last_azimuth_deg = 360;  // field of view as set in the sensor, clockwise; may wrap
  std::vector<double> vertical_deg;                      // above the plane of rotation
  std::vector<double> azimuth_offset_deg;                // clockwise, added to the azimuth in the packet
};

/** Whether this is the text of such a file: a JSON object with "lidar": "hesai". */
bool looksLikeHesai(const std::string& text);

/**
 * The key "angles" names the csv file with a sensor's own angles, as the maker supplies it; a relative path counts from
 * the folder of `name`. Throws std::invalid_argument with `name`, the key and what is expected.
 */
HesaiMetadata parseHesaiMetadata(const std::string& text, const std::string& name);
}  // namespace scanloom
