#pragma once
#include "lidar/PacketDecoder.h"

#include <vector>

namespace scanloom
{
/**
 * Blocks of one packet follow each other at a fixed distance in time, id and number; a block that does not is damaged.
 * Takes the blocks that are not valid, and those that the majority contradicts, out of `blocks`; returns how many of
 * the valid ones were contradicted. Where packets bear no ids a decoder computes all stamps from one: then a block is
 * only contradicted by an earlier one with a later stamp.
 */
std::size_t keepAgreeing(std::vector<MeasurementBlock>& blocks, Numbering, Duration block_period);
}  // namespace scanloom
