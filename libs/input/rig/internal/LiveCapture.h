#pragma once
#include "input/packets/CaptureWriter.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace scanloom
{
/** The path. Throws std::runtime_error if there is such a file: a recording is never overwritten. */
std::filesystem::path newCapture(const std::filesystem::path&);

/**
 * Writes datagrams to a capture in a thread of its own, so that nobody waits for the disk: above the memory limit
 * datagrams are dropped and counted. Flushed every second: after a crash of the program the file is readable up to its
 * last second. More than a dozen members: the writing thread's own, and what it shares under the mutex.
 */
class LiveCapture
{
 public:
  static constexpr std::size_t kMemory = 256'000'000;  // bytes waiting to be written: two seconds of eight lidars

  /** Throws std::runtime_error if the file exists already (a recording is never overwritten) or cannot be created. */
  explicit LiveCapture(const std::filesystem::path&, std::size_t memory = kMemory);
  LiveCapture(const LiveCapture&) = delete;
  LiveCapture& operator=(const LiveCapture&) = delete;
  ~LiveCapture();

  /** Copies the datagram; never waits for the disk. */
  void add(const DatagramView&);

  /** Returns when all that was added is written or, after a failure, counted as dropped. */
  void close();

  std::uint64_t dropped() const { return dropped_; }

  /** Why nothing is written any more, once; empty if there is nothing to say. */
  std::string takeFailure();

 private:
  void write();
  void writeAll(std::deque<Datagram>&);

  std::size_t memory_;
  CaptureWriter writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Datagram> waiting_;
  std::vector<std::vector<std::uint8_t>> spare_;  // payloads that are written, for their memory
  std::size_t bytes_waiting_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::string failure_;
  bool failure_taken_ = false;
  bool closing_ = false;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
