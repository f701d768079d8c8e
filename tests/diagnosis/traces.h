/** Packets of a lidar whose truth is known: one trace each, without the bytes. */
#pragma once
#include "diagnosis/internal/PacketRuns.h"

#include <functional>

namespace scanloom
{
/** 64 columns in 8 packets, 10 turns per second, frame ids of 16 bits. */
inline LidarDescription smallLidar()
{
  LidarDescription lidar;
  lidar.model = "small";
  lidar.channels = 16;
  lidar.columns_per_frame = 64;
  lidar.columns_per_packet = 8;
  lidar.first_column = 0;
  lidar.last_column = 63;
  lidar.frame_rate = 10;
  lidar.frame_id_modulus = 65536;
  return lidar;
}

/** The n-th packet after a start at `first`, received 1 ms after its last block. */
inline PacketTrace nthTrace(const LidarDescription& lidar, std::int64_t n, Timestamp first = Timestamp{1750000000s},
                            std::uint32_t first_frame = 7)
{
  const int per_turn = lidar.columns_per_frame / lidar.columns_per_packet;
  PacketTrace trace;
  trace.frame_id = static_cast<std::uint32_t>((first_frame + n / per_turn) % 65536);
  trace.measurement_id = static_cast<std::uint16_t>((n % per_turn + 1) * lidar.columns_per_packet - 1);
  trace.blocks = trace.valid_blocks = static_cast<std::uint16_t>(lidar.columns_per_packet);
  trace.stamp = first + ((n + 1) * lidar.columns_per_packet - 1) * lidar.blockPeriod();
  trace.received = *trace.stamp + 1ms;
  return trace;
}

/** `turns` of them without a fault, then changed one by one. */
inline std::vector<PacketTrace> tracesOf(const LidarDescription& lidar, int turns,
                                         const std::function<void(std::int64_t, PacketTrace&)>& change = {})
{
  std::vector<PacketTrace> traces;
  for (std::int64_t n = 0; n < turns * lidar.columns_per_frame / lidar.columns_per_packet; ++n)
  {
    traces.push_back(nthTrace(lidar, n));
    if (change) change(n, traces.back());
  }
  return traces;
}
}  // namespace scanloom
