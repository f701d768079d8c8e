/** Robosense: packets (MSOP) that are built alike, with one or two returns. */
#pragma once
#include "input/lidar/internal/StampedDecoder.h"

#include <memory>

namespace scanloom
{
constexpr std::size_t kRobosensePacketBytes = 1248;  // of data packets (MSOP) and of those about the device (DIFOP)

enum class RobosenseClock
{
  Seconds,   // since 1970, and microseconds
  Calendar,  // year to second, milliseconds, microseconds
};

struct RobosenseModel : StampedModel
{
  std::uint8_t type = 0, version = 0;  // as packets name it
  std::uint8_t old_type = 0;           // as packets that have no version name it
  ShotTimes shots;
  double lens_m = 0.03498;            // of the lens from the axis of rotation, towards the azimuth
  double lens_z_m = 0;                // of the lens above the sensor's origin
  std::uint32_t marker = 0x55AA055A;  // begins a packet
  double unit_mm = 0;                 // of ranges; 0: the packet tells
  RobosenseClock clock = RobosenseClock::Seconds;
};

extern const std::array<RobosenseModel, 6> kRobosenseModels;

/** The contents of params/lidars/robosense_*.json. Angles are in the order of the packet. */
using RobosenseMetadata = StampedMetadata<RobosenseModel>;

/** Throws std::invalid_argument with `name`, the key and what is expected. */
RobosenseMetadata parseRobosenseMetadata(const std::string& text, const std::string& name);

/**
 * Sensor frame: x forward at azimuth 0, y left, z up. Stamps are those of the sensor's clock, UTC if it is
 * synchronised. Every channel has the azimuth that the rotor has reached when it fires.
 *
 * Foreign is a packet whose header names another model; Other tells about the device (DIFOP). Packets of the Helios-16P
 * do not tell how many returns they have: by their pace, one or two differ.
 */
std::unique_ptr<PacketDecoder> makeRobosense(const RobosenseMetadata&, const Rigid& body_T_sensor);
}  // namespace scanloom
