/**
 * The inner loop of decoding: one column's channels into points. Compiled once per profile, from the profile's row of
 * kOusterProfiles, and once per kernel. All kernels give the same bits.
 */
#pragma once
#include "core/Bytes.h"
#include "core/PointCloud.h"
#include "lidar/BeamTable.h"
#include "core/Kernel.h"
#include "lidar/OusterProfiles.h"

#include <cstdint>

namespace scanloom
{
/** One column and what all its points share. */
struct OusterColumnView
{
  const std::uint8_t* channels = nullptr;  // channel_bytes for each beam of the table
  float cos_th = 1, sin_th = 0;
  std::int32_t t = 0;
  std::uint16_t measurement_id = 0;
  std::uint8_t sensor_id = 0;
};

constexpr std::size_t kMostOusterChannels = 256;

/** Appends the returns of a column. */
class OusterPoints
{
 public:
  /**
   * `profile` is a row of kOusterProfiles. Throws std::invalid_argument if the beams differ in origin or range offset,
   * or if there are none or more than
   * kMostOusterChannels.
   */
  OusterPoints(const OusterProfile& profile, BeamTable, Kernel);

  void append(const OusterColumnView& column, PointCloud& cloud) const
  {
    cloud.grow(write_(column, beams_.blocks(), static_cast<std::size_t>(beams_.size()), cloud.room(room_)));
  }

  /**
   * Writes the points of `beams` channels and returns how many; memory for roomFor(beams, returns) is touched, channels
   * and blocks are read to their ends and not past them.
   */
  using Write = std::size_t (*)(const OusterColumnView&, const BeamBlock* blocks, std::size_t beams, const PointRoom&);

 private:
  BeamTable beams_;
  std::size_t room_;
  Write write_;
};
}  // namespace scanloom
