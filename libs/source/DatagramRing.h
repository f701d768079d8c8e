#pragma once
#include "core/Time.h"
#include "source/IpAddress.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace scanloom
{
/**
 * A bounded queue of datagrams between one thread that receives and one that reads; neither ever waits for the other.
 * The bytes lie in slots that are there from the beginning. The slot that was freed last is filled next: as much memory
 * is touched as ever waited at once, and the bytes are still in the cache when they are read.
 */
class DatagramRing
{
 public:
  struct Slot
  {
    Timestamp received;
    IpAddress source;
    std::uint16_t source_port = 0;
    std::uint32_t size = 0;  // bytes of the datagram
    std::uint8_t* bytes = nullptr;
  };

  /** Throws std::invalid_argument for no slots or slots of no bytes. */
  DatagramRing(std::size_t slots, std::size_t slot_bytes);

  std::size_t slotBytes() const { return slot_bytes_; }

  /** For the receiver: a slot to be filled; null if all are waiting to be read. */
  Slot* takeEmpty();

  /** For the receiver: a slot that was taken is filled; datagrams are read in the order of these calls. */
  void push(Slot*);

  /** For the reader: the oldest datagram; null if there is none. */
  const Slot* front() const;

  /** For the reader: front() was read. */
  void pop();

  /** How many wait to be read; between two moments of the two threads. */
  std::size_t waiting() const { return filled_.size(); }

 private:
  /** Numbers of slots on their way from one thread to the other. There is room for all of them: it is never full. */
  class Lane
  {
   public:
    explicit Lane(std::size_t slots) : numbers_(slots) {}
    void push(std::uint32_t number);
    std::uint32_t front() const;
    void pop() { read_.store(read_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
    bool empty() const { return size() == 0; }
    std::size_t size() const;

   private:
    std::vector<std::uint32_t> numbers_;
    alignas(64) std::atomic<std::size_t> written_{0};  // apart: each is written by one thread only
    alignas(64) std::atomic<std::size_t> read_{0};
  };

  std::size_t slot_bytes_;
  std::unique_ptr<std::uint8_t[]> bytes_;  // not initialised: a slot that is never used costs no memory
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> empty_;  // the receiver's own; the last one is filled next
  Lane filled_, freed_;
};
}  // namespace scanloom
