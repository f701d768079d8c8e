/** A made-up sensor of few channels for tests. */
#pragma once
#include "input/lidar/OusterEncoder.h"

#include <random>
#include <string>
#include <vector>

namespace scanloom
{
inline OusterMetadata simpleMetadata(const std::string& profile, int channels = 8, int columns_per_packet = 16)
{
  OusterMetadata m;
  m.product_line = "OS-0-8";
  m.serial = "122247000785";
  m.init_id = 0xABCDEF;
  m.lidar_mode = "512x10";
  m.lidar_profile = profile;
  m.header_type = profile.rfind("FUSA_", 0) == 0 ? OusterHeader::Fusa : OusterHeader::Standard;
  m.channels = channels;
  m.columns_per_packet = columns_per_packet;
  m.columns_per_frame = 512;
  m.last_column = 511;
  m.frame_rate = 10;
  for (int i = 0; i < channels; ++i)
  {
    m.beam_altitude_deg.push_back(45.0 - 90.0 * i / channels);
    m.beam_azimuth_deg.push_back(i % 2 ? -4.2 : 8.1);
  }
  m.beam_to_lidar_mm(0, 3) = 27.116;
  m.lidar_to_sensor_mm.diagonal() << -1, -1, 1, 1;
  m.lidar_to_sensor_mm(2, 3) = 38.195;
  return m;
}

/** Columns of one packet with random fields in all channels; ranges fit into every profile. */
inline std::vector<OusterColumn> randomColumns(const OusterMetadata& m, std::uint32_t seed, std::uint32_t frame_id = 7,
                                               std::uint16_t first_column = 32)
{
  std::mt19937 random(seed);
  const auto upTo = [&random](std::uint32_t most)
  { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); };
  const auto oneReturn = [&]
  {
    return OusterReturn{upTo(3) == 0 ? 0 : 8 * upTo(0x7FFF), static_cast<std::uint8_t>(upTo(255)),
                        static_cast<std::uint16_t>(upTo(65535))};
  };
  std::vector<OusterColumn> columns;
  for (int i = 0; i < m.columns_per_packet; ++i)
  {
    OusterColumn column;
    column.stamp = fromNanoseconds(1'750'000'000'000'000'000) + i * Duration(195'313);
    column.frame_id = frame_id;
    column.measurement_id = static_cast<std::uint16_t>(first_column + i);
    for (int c = 0; c < m.channels; ++c)
    {
      OusterReading reading{oneReturn(), oneReturn(), static_cast<std::uint16_t>(16 * upTo(255))};
      if (upTo(3) == 0) reading.second.range_mm = reading.first.range_mm;  // seen twice at one place
      column.readings.push_back(reading);
    }
    columns.push_back(column);
  }
  return columns;
}
}  // namespace scanloom
