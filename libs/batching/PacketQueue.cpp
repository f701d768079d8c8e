#include "batching/PacketQueue.h"

#include <algorithm>

namespace scanloom
{
std::size_t PacketQueue::push(Bytes packet, std::vector<MeasurementBlock>& blocks, const PacketDecoder& decoder)
{
  std::size_t dropped = 0;
  if (packets_.size() >= capacity_)
  {
    dropped = packets_.front().blocks.size() - packets_.front().next;
    spare_.push_back(std::move(packets_.front()));
    packets_.pop_front();
  }

  Waiting waiting;
  if (!spare_.empty())
  {
    waiting = std::move(spare_.back());
    spare_.pop_back();
  }
  waiting.bytes.assign(packet.begin(), packet.end());
  waiting.blocks.swap(blocks);
  waiting.decoder = &decoder;
  waiting.next = 0;

  // Nearly always the end; a reordered packet goes where its first block belongs.
  const Timestamp first = waiting.blocks.front().stamp;
  auto place = packets_.end();
  while (place != packets_.begin() && first < (place - 1)->blocks[(place - 1)->next].stamp) --place;
  packets_.insert(place, std::move(waiting));
  return dropped;
}

void PacketQueue::pop()
{
  Waiting& front = packets_.front();
  if (++front.next < front.blocks.size()) return;
  spare_.push_back(std::move(front));
  packets_.pop_front();
}

void PacketQueue::shift(Duration by)
{
  for (Waiting& waiting : packets_)
    for (MeasurementBlock& block : waiting.blocks) block.stamp += by;
}

std::size_t PacketQueue::clear()
{
  std::size_t blocks = 0;
  for (; !packets_.empty(); packets_.pop_front())
  {
    blocks += packets_.front().blocks.size() - packets_.front().next;
    spare_.push_back(std::move(packets_.front()));
  }
  return blocks;
}
}  // namespace scanloom
