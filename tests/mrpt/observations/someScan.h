/** A small scan of two lidars, as the batcher would give it, for tests of what is written and read. */
#pragma once
#include "input/batching/Scan.h"
#include "input/rig/RecordingHeader.h"

namespace scanloom
{
/** 100 ms, 40 columns of 3 points: even ones of lidar 0, odd ones of lidar 1. */
inline Scan someScan(Timestamp start)
{
  Scan scan;
  scan.start = start;
  scan.period = 100ms;
  scan.columns_of = {20, 20};
  for (int c = 0; c < 40; c++)
  {
    Column column;
    const std::int32_t t = c * 2'441'403;
    column.stamp = start + Duration{t};
    column.first_point = static_cast<std::uint32_t>(scan.points.size());
    column.count = 3;
    column.sensor_id = static_cast<std::uint8_t>(c % 2);
    column.measurement_id = static_cast<std::uint16_t>((1000 + 25 * c) % 1024);
    scan.columns.push_back(column);
    for (int ring = 0; ring < 3; ring++)
    {
      const std::size_t i = scan.points.size();
      scan.points.resize(i + 1);
      scan.points.x[i] = 0.1f * static_cast<float>(i);
      scan.points.y[i] = -0.2f * static_cast<float>(c);
      scan.points.z[i] = static_cast<float>(ring);
      scan.points.intensity[i] = static_cast<float>((7 * i) % 256);
      scan.points.t[i] = t;
      scan.points.ring[i] = static_cast<std::uint16_t>(ring);
      scan.points.column[i] = column.measurement_id;
      scan.points.sensor_id[i] = column.sensor_id;
    }
  }
  return scan;
}

inline RecordingHeader someHeader()
{
  RecordingHeader header;
  header.scan_rate = 10;
  header.version = "0.1.0";
  header.lidars.push_back({"left", "992146000760", "OS-0-128",
                           Rigid::fromXyzYawPitchRoll(1.5, 1.2, 2.5, 0.5, 0.25, -0.4), 128, 1024,
                           "TIME_FROM_PTP_1588"});
  header.lidars.push_back({"right", "122246000293", "OS-0-128",
                           Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, -0.5, 0.25, 0.4), 128, 1024, ""});
  return header;
}
}  // namespace scanloom
