/** Velodyne's data packets: every model of VelodyneModels.h, one or two returns. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/lidar/internal/BeamTable.h"
#include "input/lidar/internal/VelodyneMetadata.h"
#include "input/lidar/internal/VelodynePacket.h"

#include <vector>

namespace scanloom
{
/**
 * A measurement block is one firing sequence of all lasers, stamped with its first shot; the others follow within 54
 * us, each at the azimuth that the rotor has reached by then and with its own time in PointCloud::t. Sensor frame: x
 * forward at azimuth 0, y left, z up, as the ROS and MRPT drivers have it (the maker's drawings show y forward).
 *
 * Stamps count from the top of the hour (description().stamp_modulus); packets have no numbers (Numbering::Stamps) and
 * no serial. frame_id is 0; measurement_id is the azimuth as a column of columns_per_frame: of two blocks half a column
 * apart both may have the same.
 *
 * Foreign is a packet with another product id; Other is a position packet; Malformed is also one whose number of
 * returns is not that of the metadata, since packets are put in order by how long each lasts. Of two returns the first
 * is that of the first data block of a pair (the maker: last, then strongest, or second strongest if the last is the
 * strongest).
 */
class VelodyneDecoder : public PacketDecoder
{
 public:
  VelodyneDecoder(VelodyneMetadata metadata, const Rigid& body_T_sensor);

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override;
  PacketHeader header(Bytes) const override { return {}; }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override;
  void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override;
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

  const VelodyneMetadata& metadata() const { return metadata_; }

 private:
  VelodynePacket view(Bytes packet) const { return {packet, *metadata_.model, metadata_.rpm}; }
  std::uint16_t column(double azimuth) const;

  VelodyneMetadata metadata_;
  LidarDescription description_;
  BeamTable beams_;
  std::vector<std::uint8_t> ring_;  // per laser: 0 is the topmost beam
};
}  // namespace scanloom
