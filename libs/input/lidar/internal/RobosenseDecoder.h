/** Robosense's data packets: every model of RobosenseModels.h, one or two returns. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/lidar/internal/BeamTable.h"
#include "input/lidar/internal/RobosenseMetadata.h"
#include "input/lidar/internal/RobosensePacket.h"

#include <vector>

namespace scanloom
{
/**
 * A measurement block is one firing of all channels, stamped with its first shot; the others follow within 46 us, each
 * with its own time in PointCloud::t and its own azimuth. Sensor frame: x forward at azimuth 0, y left, z up.
 *
 * Stamps are those of the sensor's clock, UTC if it is synchronised; packets are put in order by them
 * (Numbering::Stamps). frame_id is 0; measurement_id is the azimuth as a column of columns_per_frame.
 *
 * Foreign is a packet whose header names another model; Other tells about the device (DIFOP). Packets of the Helios-16P
 * do not tell how many returns they have: by their pace, one or two differ.
 */
class RobosenseDecoder : public PacketDecoder
{
 public:
  RobosenseDecoder(RobosenseMetadata metadata, const Rigid& body_T_sensor);

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override;
  PacketHeader header(Bytes) const override { return {}; }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override;
  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override;
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

  const RobosenseMetadata& metadata() const { return metadata_; }

 private:
  RobosensePacket view(Bytes packet) const;
  std::uint16_t column(double azimuth) const;

  RobosenseMetadata metadata_;
  LidarDescription description_;
  BeamTable beams_;
  std::vector<std::uint8_t> ring_;  // per channel: 0 is the topmost beam
};
}  // namespace scanloom
