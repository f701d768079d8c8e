/** The inner loop of decoding: one column's channels into points, compiled once per profile from the profile's row. */
#pragma once
#include "core/Bytes.h"
#include "core/PointCloud.h"
#include "lidar/BeamTable.h"
#include "lidar/OusterProfiles.h"

#include <cstdint>

namespace scanloom
{
/** One column and what all its points share. */
struct OusterColumnView
{
  Bytes channels;  // exactly channel_bytes per beam of the table
  float cos_th = 1, sin_th = 0;
  std::int32_t t = 0;
  std::uint16_t measurement_id = 0;
  std::uint8_t sensor_id = 0;
};

constexpr std::size_t kMostOusterChannels = 256;

/** Appends the returns of a column; the table has at most kMostOusterChannels beams. */
using AppendOusterColumn = void (*)(const OusterColumnView&, const BeamTable&, PointCloud&);

/** `profile` is a row of kOusterProfiles. */
AppendOusterColumn appenderFor(const OusterProfile& profile);
}  // namespace scanloom
