/** sensor_msgs/PointCloud2 with a stamp per point. */
#pragma once
#include "input/bags/BagReader.h"
#include "input/lidar/CloudPacket.h"

#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * The time of each point is its field t, time, timestamp, offset_time or time_stamp. Integers count from the header's
 * stamp, in ns (a turn is 1e8 of them), or in us if they span less than 2e6. So do float32, in s, ms, us or ns as they
 * span up to 1, 1e3, 1e6 or more. float64 are the same, or absolute: in the unit in which they are
 * within 5 s of the header's stamp, or, where that is not set, in s from 1e8 on, in ns from 1e15 on.
 */
struct TimedCloud
{
  std::string frame;
  std::vector<TimedPoint> points;  // as in the message
  std::string time_is;             // "field 't': uint32, ns after the header's stamp"
  bool one_instant = false;        // all points have one time: the motion within the turn is not known
  int channels = 1;                // of the field ring, channel or line

  /** The stamps of its earliest and its latest point. It must have one. */
  std::pair<Timestamp, Timestamp> span() const;
};

bool isCloudType(const std::string& type);

/**
 * Throws std::out_of_range for a message that ends too early, std::invalid_argument if it has no stamp per point (the
 * text says which fields it has), if the stamps span more than a second, or for a serialisation that can't be read.
 */
TimedCloud timedCloudOf(const BagTopic&, Bytes message);
}  // namespace scanloom
