/**
 * The inner loop of decoding: from the channels of a column to points. Compiled per row of kOusterProfiles and per
 * kernel. All kernels give the same bits.
 */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/Kernel.h"
#include "base/core/PointCloud.h"
#include "input/lidar/OusterProfiles.h"
#include "input/lidar/internal/BeamTable.h"

#include <cstdint>

namespace scanloom
{
/** The bytes of a column, and the values that its points share. */
struct OusterColumnView
{
  const std::uint8_t* channels = nullptr;  // channel_bytes for each beam of the table
  float cos_th = 1, sin_th = 0;
  std::int32_t t = 0;
  std::uint16_t measurement_id = 0;
  std::uint8_t sensor_id = 0;
};

constexpr std::size_t kMostOusterChannels = 256;

/** Appends the returns of columns to a cloud. */
class OusterPoints
{
 public:
  /**
   * `profile` is a row of kOusterProfiles. Throws std::invalid_argument if the beams differ in origin or range offset,
   * if there are none or more than kMostOusterChannels, or if this machine cannot run the kernel.
   */
  OusterPoints(const OusterProfile& profile, BeamTable, Kernel);

  void append(const OusterColumnView& column, PointCloud& cloud) const
  {
    cloud.grow(write_(column, beams_.blocks(), static_cast<std::size_t>(beams_.size()), cloud.room(room_)));
  }

  /**
   * Writes the points of `beams` channels and returns their number. It may write memory of roomFor(beams, returns)
   * points, and reads channels and blocks only up to their ends.
   */
  using Write = std::size_t (*)(const OusterColumnView&, const BeamBlock* blocks, std::size_t beams, const PointRoom&);

 private:
  BeamTable beams_;
  std::size_t room_;
  Write write_;
};
}  // namespace scanloom
