#pragma once
#include "input/lidar/PacketDecoder.h"

#include <vector>

namespace scanloom
{
/**
 * Keeps the valid blocks of a packet that agree with the majority: blocks follow each other at fixed intervals of time
 * and id, and one that does not is damaged. Returns how many valid blocks were removed. In packets without ids, two
 * blocks may be up to a turn apart.
 */
std::size_t keepAgreeing(std::vector<MeasurementBlock>& blocks, Numbering, Duration block_period);
}  // namespace scanloom
