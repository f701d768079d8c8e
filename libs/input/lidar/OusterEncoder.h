/** From readings to the bytes that a sensor sends: for simulation and tests. */
#pragma once
#include "base/core/ImuSample.h"
#include "input/lidar/OusterMetadata.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct OusterReturn
{
  std::uint32_t range_mm = 0;  // 0: no return
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
  std::vector<OusterReading> readings;  // one per channel; empty: no returns
};

/**
 * Writes the layouts that OusterDecoder reads. Values are rounded to the steps of the profile (ranges 8 mm, near
 * infrared 16); fields that it lacks (signal, second return) are left out; a range that does not fit is written as no
 * return.
 */
class OusterEncoder
{
 public:
  /** Throws std::invalid_argument as parseOusterMetadata does where `metadata` was filled by hand. */
  explicit OusterEncoder(const OusterMetadata& metadata);

  /**
   * Takes columns_per_packet columns of one frame. The header gets the frame id of the first one, modulo
   * frame_id_modulus. Throws std::invalid_argument for another number of columns or readings.
   */
  std::vector<std::uint8_t> lidarPacket(const std::vector<OusterColumn>&) const;

  /** Takes imuSamplesPerPacket() samples in the IMU's frame, oldest first. Throws std::invalid_argument otherwise. */
  std::vector<std::uint8_t> imuPacket(const std::vector<ImuSample>&, std::uint32_t frame_id = 0) const;

  /** 1 in LEGACY packets; 0 if the sensor sends no IMU packets. */
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
