#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

namespace scanloom
{
/**
 * Of each cloud one per lidar of the header, empty ones too, in the header's order: label `lidar_<name>`, same stamp,
 * frame, fields and options. Where mergeOrder() would not find the order of the points again (stamps nearer to each
 * other than `t` can tell), they bear it in a field kOrderField. Throws std::invalid_argument for clouds without
 * sensor_id.
 */
RawlogOperation splitLidars(const RecordingHeader&);
}  // namespace scanloom
