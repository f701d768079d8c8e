#pragma once
#include "core/Bytes.h"
#include "lidar/PacketDecoder.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace scanloom
{
/** One lidar's packets with blocks still to be taken, oldest block first. Buffers are used again. */
class PacketQueue
{
 public:
  using Decoder = std::shared_ptr<const PacketDecoder>;

  explicit PacketQueue(std::size_t capacity) : capacity_(capacity) {}

  /** Copies the packet; `blocks` are its usable ones in time order, at least one. Returns the blocks dropped for it
   * when full. */
  std::size_t push(Bytes packet, const std::vector<MeasurementBlock>& blocks, const Decoder&);

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
    Decoder decoder;
    std::size_t next = 0;
  };

  std::size_t capacity_;
  std::deque<Waiting> packets_;
  std::vector<Waiting> spare_;
};
}  // namespace scanloom
