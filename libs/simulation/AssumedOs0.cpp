#include "simulation/AssumedOs0.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace scanloom
{
namespace
{
double altitudeDeg(double u) { return 43.9 * u + 1.6 * u * u * u; }  // u from 1 (topmost beam) to -1
double azimuthDeg(double u) { return 8.4 + 2.6 * u * u; }

struct Mode
{
  int columns = 0;
  int rate = 0;
};

Mode parseMode(const std::string& text)
{
  Mode mode;
  const char* end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, mode.columns);
  const bool has_cross = columns.ec == std::errc{} && columns.ptr != end && *columns.ptr == 'x';
  const auto rate = has_cross ? std::from_chars(columns.ptr + 1, end, mode.rate) : columns;
  const bool known_columns = mode.columns == 512 || mode.columns == 1024 || mode.columns == 2048;
  if (!has_cross || rate.ptr != end || !known_columns || (mode.rate != 10 && mode.rate != 20))
    throw std::invalid_argument(fmt::format("mode = '{}': must be 512x10, 1024x10, 2048x10, 512x20 or 1024x20", text));
  return mode;
}

void requireProfile(const std::string& name)
{
  const auto named = [&](const OusterProfile& profile) { return profile.name == name; };
  if (std::none_of(kOusterProfiles.begin(), kOusterProfiles.end(), named))
    throw std::invalid_argument(
        fmt::format("profile = '{}': must be a UDP profile of Ouster's, RNG15_RFL8_NIR8 or "
                    "RNG19_RFL8_SIG16_NIR16 for instance",
                    name));
}
}  // namespace

OusterMetadata assumedOs0(const Os0Options& options, const std::string& serial, std::uint32_t init_id,
                          std::uint16_t lidar_port)
{
  requireProfile(options.profile);
  const Mode mode = parseMode(options.mode);

  OusterMetadata os0;
  os0.product_line = fmt::format("OS-0-{}", options.beams);
  os0.serial = serial;
  os0.firmware = "v3.0.1";
  os0.init_id = init_id;
  os0.lidar_mode = options.mode;
  os0.timestamp_mode = "TIME_FROM_PTP_1588";
  os0.lidar_profile = options.profile;
  os0.channels = options.beams;
  os0.columns_per_frame = mode.columns;
  os0.last_column = mode.columns - 1;
  os0.frame_rate = mode.rate;
  os0.lidar_port = lidar_port;
  os0.imu_port = static_cast<std::uint16_t>(lidar_port + 1);
  for (int beam = 0; beam < options.beams; ++beam)
  {
    const double u = 1 - (2 * beam + 1.0) / options.beams;
    os0.beam_altitude_deg.push_back(altitudeDeg(u));
    os0.beam_azimuth_deg.push_back(azimuthDeg(u));
  }
  // Nominal values of the generation, mm: hardware manual's drawings of the OS0, rev. 06 and later.
  os0.beam_to_lidar_mm(0, 3) = 27.67;
  os0.lidar_to_sensor_mm.diagonal() << -1, -1, 1, 1;
  os0.lidar_to_sensor_mm(2, 3) = 36.18;
  os0.imu_to_sensor_mm.topRightCorner<3, 1>() << 6.253, -11.775, 7.645;
  return os0;
}
}  // namespace scanloom
