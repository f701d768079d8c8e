/** Sends recorded datagrams to UDP ports with their recorded timing. */
#pragma once
#include "input/packets/Datagram.h"
#include "lab/simulation/internal/DatagramSender.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
struct StreamOptions
{
  std::string destination = "127.0.0.1";
  double speed = 1;  // how many times faster than recorded

  /** When, on this computer's clock, what is stamped `origin` is sent: the same for sensors that belong together. */
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  Timestamp origin;  // zero: the first datagram's
};

/** All datagrams of a capture; of one sender if `source` is given. Throws as CaptureReader does. */
std::vector<Datagram> readDatagrams(const std::filesystem::path& capture, const std::string& source = "");

/** Sends in a thread of its own; `destination_port` of each datagram says where. */
class DatagramStream
{
 public:
  /** Throws std::runtime_error if the socket can't be opened or bound to `source`. */
  DatagramStream(std::vector<Datagram>, const IpAddress& source, const StreamOptions&);
  ~DatagramStream();

  DatagramStream(const DatagramStream&) = delete;
  DatagramStream& operator=(const DatagramStream&) = delete;

  /** Until the last datagram is sent. */
  void wait();

  std::uint64_t sent() const { return sent_; }
  std::uint64_t refused() const { return refused_; }  // by the operating system: too large, no buffer

 private:
  void run(const std::vector<Datagram>&, const IpAddress& destination, const StreamOptions&);

  DatagramSender sender_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> sent_{0}, refused_{0};
  std::thread thread_;
};
}  // namespace scanloom
