#include "dataset/PacketTrace.h"

#include <cmath>

namespace scanloom
{
Timestamp unwrapped(Timestamp stamp, Duration round, Timestamp expected)
{
  if (round == Duration{0}) return stamp;
  return stamp + std::llround(seconds(expected - stamp) / seconds(round)) * round;
}

bool inAzimuthWindow(const LidarDescription& lidar, int column)
{
  return lidar.first_column <= lidar.last_column ? column >= lidar.first_column && column <= lidar.last_column
                                                 : column >= lidar.first_column || column <= lidar.last_column;
}

PacketTrace traceOf(const PacketDecoder& decoder, Bytes packet, Timestamp received,
                    std::vector<MeasurementBlock>& blocks)
{
  const PacketHeader header = decoder.header(packet);
  PacketTrace trace;
  trace.received = received;
  trace.init_id = header.init_id;
  trace.alert_flags = header.alert_flags;
  trace.thermal_status = header.thermal_status;
  trace.shot_limiting_status = header.shot_limiting_status;

  decoder.readBlocks(packet, blocks);
  for (const MeasurementBlock& block : blocks)
  {
    if (inAzimuthWindow(decoder.description(), block.measurement_id)) ++trace.blocks;
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
