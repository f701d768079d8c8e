#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/CGenericPointsMap.h"
#include "mrpt_bridge/RecordingHeader.h"

namespace scanloom
{
/** Places in the whole cloud: only in clouds whose own fields do not tell them. */
inline constexpr const char* kOrderField = "order";

/**
 * Clouds `lidar_<name>` of equal stamps into one, `lidar`: undoes splitLidars() to the byte. A cloud waits for those of
 * the other lidars until the next stamp begins; whatever is no such cloud passes by.
 */
RawlogOperation mergeLidars(const RecordingHeader&);

/**
 * Which point of the clouds, counted through one behind the other, comes when: by kOrderField if all have it, else by
 * (t, sensor_id, column), equal ones as they are. Throws std::invalid_argument if neither is there.
 */
std::vector<std::uint32_t> mergeOrder(const std::vector<mrpt::maps::CGenericPointsMap::Ptr>&);
}  // namespace scanloom
