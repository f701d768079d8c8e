/** Velodyne: one packet format for all models, with one or two returns. */
#pragma once
#include "input/lidar/internal/StampedDecoder.h"

#include <memory>

namespace scanloom
{
constexpr std::size_t kVelodynePacketBytes = 1206;

struct VelodyneModel : StampedModel
{
  ShotTimes shots;
  std::uint8_t product_id = 0;        // last byte of packets
  std::uint8_t early_product_id = 0;  // of the first ones that were built; 0: they have the same
  Duration first_shot{0};             // of a packet, after its stamp
  int range_unit_mm = 2;
  bool dual_return = true;  // false: its format of two returns is not known
};

extern const std::array<VelodyneModel, 4> kVelodyneModels;

/** The contents of params/lidars/velodyne_*.json. Angles and offsets are in the order of firing. */
struct VelodyneMetadata : StampedMetadata<VelodyneModel>
{
  std::uint8_t product_id = 0;             // that of the model unless the file has one
  std::uint8_t early_product_id = 0;       // of packets whose rotor turns as set in the sensor; 0: none
  std::vector<double> vertical_offset_mm;  // of the ray's origin
};

/** Throws std::invalid_argument with `name`, the key and what is expected. */
VelodyneMetadata parseVelodyneMetadata(const std::string& text, const std::string& name);

/**
 * Sensor frame: x forward at azimuth 0, y left, z up, as the ROS and MRPT drivers have it (the maker's drawings show y
 * forward). Stamps count from the top of the hour (stamp_modulus). Every laser has the azimuth that the rotor has
 * reached when it fires.
 *
 * Foreign is a packet with another product id; Other is a position packet; Malformed is also one whose number of
 * returns is not that of the metadata, since packets are put in order by how long each lasts. Of two returns the first
 * is that of the first data block of a pair (the maker: last, then strongest, or second strongest if the last is the
 * strongest).
 */
std::unique_ptr<PacketDecoder> makeVelodyne(const VelodyneMetadata&, const Rigid& body_T_sensor);
}  // namespace scanloom
