#pragma once
#include "base/core/Time.h"
#include "input/packets/IpAddress.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace scanloom
{
/**
 * A bounded queue of datagrams between one thread that receives and one that reads, without locks. All slots for the
 * bytes are allocated at construction. The slot that was freed last is filled next, so that few slots are in use and
 * their bytes stay in the cache.
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

  /** Throws std::invalid_argument if either is 0. */
  DatagramRing(std::size_t slots, std::size_t slot_bytes);

  std::size_t slotBytes() const { return slot_bytes_; }

  /** For the receiver: an empty slot; null if all are waiting to be read. */
  Slot* takeEmpty();

  /** For the receiver: queues a slot from takeEmpty() that it has filled. */
  void push(Slot*);

  /** For the reader: the oldest datagram; null if there is none. */
  const Slot* front() const;

  /** For the reader: frees the slot of front(). */
  void pop();

  /** Number of datagrams that wait to be read. It may change at any moment. */
  std::size_t waiting() const { return filled_.size(); }

 private:
  /** Numbers of slots that one thread passes to the other. It has room for all slots, so it is never full. */
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
    alignas(64) std::atomic<std::size_t> written_{0};  // in cache lines of their own: each is written by one thread
    alignas(64) std::atomic<std::size_t> read_{0};
  };

  std::size_t slot_bytes_;
  std::unique_ptr<std::uint8_t[]> bytes_;  // not initialised: unused slots take no memory
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> empty_;  // used by the receiver only; the last one is filled next
  Lane filled_, freed_;
};
}  // namespace scanloom
