#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/PacketDecoder.h"

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
  explicit PacketQueue(std::size_t capacity) : capacity_(capacity) {}

  /**
   * Copies the packet and takes its usable blocks, at least one, in time order. Returns how many blocks were dropped
   * for it because the queue was full.
   */
  std::size_t push(Bytes packet, std::vector<MeasurementBlock> blocks, std::shared_ptr<const PacketDecoder>);

  bool empty() const { return packets_.empty(); }

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
    std::shared_ptr<const PacketDecoder> decoder;
    std::size_t next = 0;
  };

  std::size_t dropFront();

  std::size_t capacity_;
  std::deque<Waiting> packets_;
  std::vector<std::vector<std::uint8_t>> spare_;  // bytes of packets that are gone, for their memory
};
}  // namespace scanloom
