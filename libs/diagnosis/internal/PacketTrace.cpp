#include "diagnosis/internal/PacketTrace.h"

#include "input/lidar/AzimuthWindow.h"

namespace scanloom
{
PacketTrace traceOf(const RoutedPacket& packet, const LidarDescription& lidar)
{
  const PacketHeader& header = packet.header;
  PacketTrace trace;
  trace.received = packet.received;
  trace.init_id = header.init_id;
  trace.alert_flags = header.alert_flags;
  trace.thermal_status = header.thermal_status;
  trace.shot_limiting_status = header.shot_limiting_status;

  for (const MeasurementBlock& block : packet.blocks)
  {
    if (inAzimuthWindow(lidar, block.measurement_id)) ++trace.blocks;
    if (!block.valid && trace.stamp) continue;
    trace.frame_id = block.frame_id;
    trace.measurement_id = block.measurement_id;
    if (!block.valid) continue;
    ++trace.valid_blocks;
    trace.stamp = block.stamp;
  }
  return trace;
}
}  // namespace scanloom
