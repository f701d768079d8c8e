/** The other direction: readings to the bytes that a sensor would send. For simulation and tests. */
#pragma once
#include "core/ImuSample.h"
#include "lidar/OusterMetadata.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct OusterReturn
{
  std::uint32_t range_mm = 0;  // 0: nothing came back
  std::uint8_t reflectivity = 0;
  std::uint16_t signal = 0;  // photons
};

struct OusterReading
{
  OusterReturn first, second;
  std::uint16_t near_ir = 0;  // photons
};

struct OusterColumn
{
  Timestamp stamp;
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;
  bool valid = true;
  std::vector<OusterReading> readings;  // one per channel; may be empty: nothing came back
};

/**
 * Writes through the layouts that OusterDecoder reads. What a profile can't hold is rounded to its steps (ranges of 8
 * mm, near infrared of 16) or left out (signal, the second return); a range beyond the profile's reach is no return.
 */
class OusterEncoder
{
 public:
  /** Throws std::invalid_argument as parseOusterMetadata does where `metadata` was filled by hand. */
  explicit OusterEncoder(const OusterMetadata& metadata);

  /**
   * Needs columns_per_packet columns of one frame; the header's frame id is that of the first one, modulo what its
   * field holds. Throws std::invalid_argument on another number of columns or of readings.
   */
  std::vector<std::uint8_t> lidarPacket(const std::vector<OusterColumn>&) const;

  /** Needs imuSamplesPerPacket() samples in the IMU's frame, oldest first; throws std::invalid_argument otherwise. */
  std::vector<std::uint8_t> imuPacket(const std::vector<ImuSample>&, std::uint32_t frame_id = 0) const;

  /** 1 in LEGACY packets, 0 if the sensor sends none. */
  std::size_t imuSamplesPerPacket() const;

  const OusterMetadata& metadata() const { return metadata_; }

 private:
  void writeHeader(std::vector<std::uint8_t>& packet, OusterHeader, std::uint64_t type, std::uint32_t frame_id) const;
  void writeColumn(std::vector<std::uint8_t>& packet, std::size_t offset, const OusterColumn&) const;
  void writeChannel(std::vector<std::uint8_t>& packet, std::size_t offset, const OusterReading&) const;

  OusterMetadata metadata_;
  OusterLayout layout_;
};
}  // namespace scanloom
