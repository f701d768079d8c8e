#pragma once
#include "source/CaptureWriter.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace scanloom
{
/**
 * Writes datagrams to a capture in a thread of its own, so that a slow disk keeps nobody waiting: what would take more
 * memory than allowed is dropped and counted. Flushed every second: after a crash (of the program, not the computer)
 * the file is readable up to its last second.
 */
class LiveCapture
{
 public:
  static constexpr std::size_t kMemory = 256'000'000;  // bytes waiting to be written: two seconds of eight lidars

  /** Throws std::runtime_error if the file exists already (a recording is not to be replaced) or cannot be created. */
  explicit LiveCapture(const std::filesystem::path&, std::size_t memory = kMemory);
  LiveCapture(const LiveCapture&) = delete;
  LiveCapture& operator=(const LiveCapture&) = delete;
  ~LiveCapture();

  /** Copies it; never waits for the disk. */
  void add(const DatagramView&);

  /** All that was added is written, or known to be lost: see failure(). */
  void close();

  std::uint64_t dropped() const { return dropped_; }

  /** Empty, or why nothing is written any more. */
  std::string failure() const;

 private:
  void write();
  void writeAll(std::deque<Datagram>&);

  std::size_t memory_;
  CaptureWriter writer_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Datagram> waiting_;
  std::vector<std::vector<std::uint8_t>> spare_;  // payloads to be used again
  std::size_t bytes_waiting_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::string failure_;
  bool closing_ = false;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
