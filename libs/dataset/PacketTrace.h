/** One lidar packet without its points: all that the measures of delivery and clocks need. */
#pragma once
#include "lidar/PacketDecoder.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct PacketTrace
{
  Timestamp received;              // clock of the recording computer
  std::optional<Timestamp> stamp;  // of the last valid block; none if no block is valid
  std::uint32_t frame_id = 0;      // of that block, or of the packet's last one
  std::uint16_t measurement_id = 0;
  std::uint16_t blocks = 0;  // within the azimuth window
  std::uint16_t valid_blocks = 0;
  std::optional<std::uint32_t> init_id;
  std::uint8_t alert_flags = 0, thermal_status = 0, shot_limiting_status = 0;
};

/** `packet` must be of PacketKind::Lidar; `blocks` is room for its headers. */
PacketTrace traceOf(const PacketDecoder&, Bytes packet, Timestamp received, std::vector<MeasurementBlock>& blocks);

/** Of the stamps that a clock shows which counts modulo `round`: the one nearest to `expected`. 0: it does not wrap. */
Timestamp unwrapped(Timestamp stamp, Duration round, Timestamp expected);

/** Whether the lidar measures there: its azimuth window is [first_column, last_column] and may wrap around 0. */
bool inAzimuthWindow(const LidarDescription&, int column);
}  // namespace scanloom
