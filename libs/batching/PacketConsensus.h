#pragma once
#include "lidar/PacketDecoder.h"

#include <vector>

namespace scanloom
{
/**
 * Blocks of one packet follow each other at a fixed distance in time, id and number; a block that does not is damaged.
 * Takes the blocks that are not valid, and those that the majority contradicts, out of `blocks`; returns how many of
 * the valid ones were contradicted. Where packets bear no ids
 * there may be a gap of up to a turn between two blocks.
 */
std::size_t keepAgreeing(std::vector<MeasurementBlock>& blocks, Numbering, Duration block_period);
}  // namespace scanloom
