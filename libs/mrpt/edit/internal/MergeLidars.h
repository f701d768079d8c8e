#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/observations/CGenericPointsMap.h"

namespace scanloom
{
/** Index of each point in the merged cloud; only in clouds whose other fields do not tell the order. */
inline constexpr const char* kOrderField = "order";

/**
 * Merges clouds `lidar_<name>` of equal stamps into one, `lidar`: the exact inverse of splitLidars(). A cloud waits for
 * those of the other lidars until a cloud with another stamp comes; all other observations pass at once.
 */
RawlogOperation mergeLidars(const RecordingHeader&);

/**
 * The order of the points in the merged cloud, as indices into the clouds' points one cloud after another: by
 * kOrderField if all clouds have it, else by (t, sensor_id, column), ties in the clouds' order. Throws
 * std::invalid_argument if a cloud has neither.
 */
std::vector<std::uint32_t> mergeOrder(const std::vector<mrpt::maps::CGenericPointsMap::Ptr>&);
}  // namespace scanloom
