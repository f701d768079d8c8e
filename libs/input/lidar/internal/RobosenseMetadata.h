/** The file with model, settings and beam angles of a Robosense sensor: params/lidars/robosense_*.json. */
#pragma once
#include "input/lidar/internal/AngleTable.h"
#include "input/lidar/internal/RobosenseModels.h"

#include <string>

namespace scanloom
{
struct RobosenseMetadata
{
  const RobosenseModel* model = nullptr;  // a row of kRobosenseModels
  std::string serial;                     // for reports only: data packets have none
  double rpm = 600;                       // as set in the sensor
  int returns = 1;                        // as set in the sensor: 1 or 2
  std::uint16_t lidar_port = 6699;
  double first_azimuth_deg = 0, last_azimuth_deg = 360;  // field of view as set in the sensor, clockwise; may wrap
  AngleTable angles;  // above the plane of rotation; clockwise, added to the azimuth in the packet
};

/** Whether this is the text of such a file: a JSON object with "lidar": "robosense". */
bool looksLikeRobosense(const std::string& text);

/**
 * The key "angles" names the csv file with a sensor's own angles, as the maker's viewer writes it; a relative path
 * counts from the folder of `name`. Throws std::invalid_argument with `name`, the key and what is expected.
 */
RobosenseMetadata parseRobosenseMetadata(const std::string& text, const std::string& name);
}  // namespace scanloom
