#pragma once
#include "core/Bytes.h"
#include "lidar/PacketDecoder.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace scanloom
{
/** One lidar's packets with blocks still to be taken, oldest block first. Buffers are used again. */
class PacketQueue
{
 public:
  explicit PacketQueue(std::size_t capacity) : capacity_(capacity) {}

  /**
   * Copies the packet and takes the blocks: its usable ones in time order, at least one; `blocks` is left with memory
   * of any content. The decoder must outlive the packet. Returns the blocks dropped for it when full.
   */
  std::size_t push(Bytes packet, std::vector<MeasurementBlock>& blocks, const PacketDecoder&);

  bool empty() const { return packets_.empty(); }
  std::size_t packets() const { return packets_.size(); }

  /** The oldest block; the queue must not be empty. */
  const MeasurementBlock& front() const { return packets_.front().blocks[packets_.front().next]; }
  Bytes frontPacket() const { return packets_.front().bytes; }
  const PacketDecoder& frontDecoder() const { return *packets_.front().decoder; }
  void pop();

  /** Adds to every stamp. */
  void shift(Duration);

  /** Takes everything out; returns how many blocks that were. */
  std::size_t clear();

 private:
  struct Waiting
  {
    std::vector<std::uint8_t> bytes;
    std::vector<MeasurementBlock> blocks;
    const PacketDecoder* decoder = nullptr;
    std::size_t next = 0;
  };

  std::size_t capacity_;
  std::deque<Waiting> packets_;
  std::vector<Waiting> spare_;
};
}  // namespace scanloom
