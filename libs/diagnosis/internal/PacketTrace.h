/** The headers of one lidar packet, as far as the measures of delivery and clocks need them. */
#pragma once
#include "input/batching/RoutedPacket.h"

#include <optional>

namespace scanloom
{
struct PacketTrace
{
  Timestamp received;              // clock of the recording computer
  std::optional<Timestamp> stamp;  // of the last valid block; none if no block is valid
  std::uint32_t frame_id = 0;      // of that block; of the last block if none is valid
  std::uint16_t measurement_id = 0;
  std::uint16_t blocks = 0;  // within the azimuth window
  std::uint16_t valid_blocks = 0;
  std::optional<std::uint32_t> init_id;
  std::uint8_t alert_flags = 0, thermal_status = 0, shot_limiting_status = 0;
};

/** Of a lidar packet. */
PacketTrace traceOf(const RoutedPacket&, const LidarDescription&);
}  // namespace scanloom
