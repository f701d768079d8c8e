#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

namespace scanloom
{
/**
 * Splits each cloud into one per lidar, in the header's order and also for lidars without points: label `lidar_<name>`,
 * same stamp, frame, fields and options. Where mergeOrder() could not restore the order of the points (stamps nearer to
 * each other than the float `t` can tell), a field kOrderField keeps it. Throws std::invalid_argument for clouds
 * without sensor_id.
 */
RawlogOperation splitLidars(const RecordingHeader&);
}  // namespace scanloom
