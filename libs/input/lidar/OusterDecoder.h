/** Ouster's packets: every profile of OusterProfiles.h, both header types, both IMU formats. */
#pragma once
#include "base/core/Kernel.h"
#include "input/lidar/OusterMetadata.h"
#include "input/lidar/PacketDecoder.h"
#include "input/lidar/internal/BeamTable.h"
#include "input/lidar/internal/OusterPoints.h"

#include <vector>

namespace scanloom
{
/**
 * Points: x, y, z by BeamTable; intensity is REFLECTIVITY; a range of 0 is no return; of two returns the second is left
 * out where its range is 0 or that of the first. A block is invalid if the sensor says so, and also if its measurement
 * id is outside the turn or its stamp outside of 62 bits of ns: no points come from it.
 *
 * A packet whose header has another serial number is Foreign, whatever its size. Another init id does not make it so:
 * the sensor has started again (header()). A packet is not intact if the last 8 bytes after a STANDARD header are
 * neither its CRC-64 nor one of the two values of firmware that computes none (0 in 2.2, 0xDEADBEEF0000C0DE in 2.3).
 *
 * LEGACY IMU packets have three stamps; the sample gets the gyroscope's. The accelerometer is read 0.2 ms before it (in
 * every recording at hand); the first stamp counts from the sensor's start, whatever the timestamp mode.
 */
class OusterDecoder : public PacketDecoder
{
 public:
  /**
   * Throws std::invalid_argument for metadata, filled by hand, that describe no packets, and if this machine cannot run
   * the kernel.
   */
  OusterDecoder(OusterMetadata metadata, const Rigid& body_T_sensor, Kernel = widestKernel());

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override;
  bool isIntact(Bytes packet) const override;
  PacketHeader header(Bytes packet) const override;
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override;
  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override;
  std::vector<ImuSample> imuSamples(Bytes packet) const override;

  const OusterMetadata& metadata() const { return metadata_; }
  const OusterLayout& layout() const { return layout_; }

 private:
  MeasurementBlock readBlock(const std::uint8_t* column, std::size_t index, std::uint32_t packet_frame_id) const;
  bool isForeign(Bytes packet) const;

  struct Format
  {
    PacketKind kind;
    OusterHeader header;
  };
  std::optional<Format> formatOf(Bytes packet) const;

  OusterMetadata metadata_;
  OusterLayout layout_;
  LidarDescription description_;
  std::optional<std::uint64_t> serial_;
  bool is_legacy_;
  std::size_t first_column_, column_bytes_, channels_in_column_;  // of layout_, which computes them
  ColumnAngles angles_;
  OusterPoints points_;
};

/** The beams of a sensor in its lidar frame: documented formula of the maker's SDK (destaggering is not involved). */
std::vector<Beam> beamsOf(const OusterMetadata&);

/** Translations from mm to m. */
Rigid rigidFromMillimetres(Eigen::Matrix4d);
}  // namespace scanloom
