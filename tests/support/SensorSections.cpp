#include "support/SensorSections.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::array<std::pair<std::string_view, const char*>, 8> kSectionOf{{
    {"beam_altitude_angles", "beam_intrinsics"},
    {"beam_azimuth_angles", "beam_intrinsics"},
    {"lidar_origin_to_beam_origin_mm", "beam_intrinsics"},
    {"beam_to_lidar_transform", "beam_intrinsics"},
    {"lidar_to_sensor_transform", "lidar_intrinsics"},
    {"imu_to_sensor_transform", "imu_intrinsics"},
    {"lidar_mode", "config_params"},
    {"timestamp_mode", "config_params"},
}};

const char* sectionOf(const std::string& key)
{
  if (key.rfind("udp_", 0) == 0) return "config_params";
  const auto found =
      std::find_if(kSectionOf.begin(), kSectionOf.end(), [&](const auto& row) { return row.first == key; });
  return found == kSectionOf.end() ? "sensor_info" : found->second;
}
}  // namespace

nlohmann::json sensorSections(const std::string& metadata)
{
  const nlohmann::json given = nlohmann::json::parse(metadata, nullptr, false);
  if (!given.is_object()) throw std::invalid_argument("a fake sensor needs metadata that are a JSON object");
  if (given.contains("sensor_info")) return given;

  nlohmann::json sections;
  for (const auto& [key, value] : given.items())
    if (key == "data_format")
      sections["lidar_data_format"] = value;
    else
      sections[sectionOf(key)][key] = value;
  return sections;
}
}  // namespace scanloom
