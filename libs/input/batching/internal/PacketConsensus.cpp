#include "input/batching/internal/PacketConsensus.h"

#include "base/core/Statistics.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
// Between the columns of one packet: sensors stamp to the microsecond, and rotors do not jerk.
constexpr Duration kTolerance = 1ms;

// A packet without ids may begin before a part of the turn that is not sent and end after it.
constexpr Duration kLongestTurn = 250ms;

/** Stamp and ids of a packet's block 0, as one of its blocks implies them. */
struct Origin
{
  Timestamp stamp;
  int measurement_id = 0;
  std::uint32_t frame_id = 0;
};

Origin impliedBy(const MeasurementBlock& b, Duration block_period)
{
  return {b.stamp - block_period * b.index, b.measurement_id - b.index, b.frame_id};
}

bool agree(const Origin& a, const Origin& b, Numbering numbering)
{
  const Duration off = a.stamp > b.stamp ? a.stamp - b.stamp : b.stamp - a.stamp;
  if (numbering == Numbering::Stamps) return off <= kLongestTurn;
  return off <= kTolerance && a.measurement_id == b.measurement_id && a.frame_id == b.frame_id;
}

template <typename Value>
Value median(const std::vector<Origin>& origins, Value Origin::*member)
{
  std::vector<Value> values;
  for (const Origin& origin : origins) values.push_back(origin.*member);
  return upperMedian(std::move(values));
}

Origin majority(const std::vector<MeasurementBlock>& blocks, Duration block_period)
{
  std::vector<Origin> origins;
  for (const MeasurementBlock& block : blocks) origins.push_back(impliedBy(block, block_period));
  return {median(origins, &Origin::stamp), median(origins, &Origin::measurement_id),
          median(origins, &Origin::frame_id)};
}

/** Keeps blocks that agree with `origin` and do not go back in time; returns how many do not. */
std::size_t keepWhatAgrees(std::vector<MeasurementBlock>& blocks, const Origin& origin, Numbering numbering,
                           Duration block_period)
{
  std::size_t kept = 0;
  for (const MeasurementBlock& block : blocks)
    if (agree(impliedBy(block, block_period), origin, numbering) &&
        (kept == 0 || block.stamp >= blocks[kept - 1].stamp))
      blocks[kept++] = block;
  const std::size_t refused = blocks.size() - kept;
  blocks.resize(kept);
  return refused;
}
}  // namespace

std::size_t keepAgreeing(std::vector<MeasurementBlock>& blocks, Numbering numbering, Duration block_period)
{
  const auto invalid = [](const MeasurementBlock& b) { return !b.valid; };
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), invalid), blocks.end());
  if (blocks.empty()) return 0;

  const Origin first = impliedBy(blocks.front(), block_period);
  const bool unanimous =
      std::all_of(blocks.begin(), blocks.end(),
                  [&](const MeasurementBlock& b) { return agree(impliedBy(b, block_period), first, numbering); });
  return keepWhatAgrees(blocks, unanimous ? first : majority(blocks, block_period), numbering, block_period);
}
}  // namespace scanloom
