/** Hesai's data packets: every model of HesaiModels.h, one or two returns. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/lidar/internal/BeamTable.h"
#include "input/lidar/internal/HesaiMetadata.h"
#include "input/lidar/internal/HesaiPacket.h"

#include <vector>

namespace scanloom
{
/**
 * A measurement block is one firing of all channels, stamped with its first shot; the others follow within 101 us
 * (QT64: 135 us), each with its own time in PointCloud::t. All have the azimuth of their block, as in the maker's own
 * drivers by default. Sensor frame: the maker's, y forward at azimuth 0, x to the right, z up.
 *
 * Stamps are UTC by the sensor's clock; packets are put in order by them (Numbering::Stamps). frame_id is 0;
 * measurement_id is the azimuth as a column of columns_per_frame.
 *
 * Foreign is a packet whose header names other channels, blocks or another protocol (packets of the 40P have no
 * header); Other is a position packet; Malformed is also one whose number of returns is not that of the metadata.
 */
class HesaiDecoder : public PacketDecoder
{
 public:
  HesaiDecoder(HesaiMetadata metadata, const Rigid& body_T_sensor);

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override;
  PacketHeader header(Bytes) const override { return {}; }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override;
  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override;
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

  const HesaiMetadata& metadata() const { return metadata_; }

 private:
  std::uint16_t column(int azimuth) const;

  HesaiMetadata metadata_;
  LidarDescription description_;
  BeamTable beams_;
  std::vector<std::uint8_t> ring_;  // per channel: 0 is the topmost beam
};
}  // namespace scanloom
