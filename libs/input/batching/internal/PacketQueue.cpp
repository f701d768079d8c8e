#include "input/batching/internal/PacketQueue.h"

#include <algorithm>

namespace scanloom
{
std::size_t PacketQueue::push(Bytes packet, std::vector<MeasurementBlock> blocks,
                              std::shared_ptr<const PacketDecoder> decoder)
{
  const std::size_t dropped = packets_.size() >= capacity_ ? dropFront() : 0;

  Waiting waiting;
  if (!spare_.empty())
  {
    waiting.bytes = std::move(spare_.back());
    spare_.pop_back();
  }
  waiting.bytes.assign(packet.begin(), packet.end());
  waiting.blocks = std::move(blocks);
  waiting.decoder = std::move(decoder);

  // Nearly always the end; a reordered packet goes where its first block belongs.
  const Timestamp first = waiting.blocks.front().stamp;
  auto place = packets_.end();
  while (place != packets_.begin() && first < (place - 1)->blocks[(place - 1)->next].stamp) --place;
  packets_.insert(place, std::move(waiting));
  return dropped;
}

void PacketQueue::pop()
{
  if (++packets_.front().next == packets_.front().blocks.size()) dropFront();
}

void PacketQueue::shift(Duration by)
{
  for (Waiting& waiting : packets_)
    for (MeasurementBlock& block : waiting.blocks) block.stamp += by;
}

std::size_t PacketQueue::clear()
{
  std::size_t blocks = 0;
  while (!packets_.empty()) blocks += dropFront();
  return blocks;
}

/** How many blocks of it had not been taken. */
std::size_t PacketQueue::dropFront()
{
  const std::size_t blocks = packets_.front().blocks.size() - packets_.front().next;
  spare_.push_back(std::move(packets_.front().bytes));
  packets_.pop_front();
  return blocks;
}
}  // namespace scanloom
