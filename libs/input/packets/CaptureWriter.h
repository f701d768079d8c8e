#pragma once
#include "input/packets/Datagram.h"

#include <filesystem>
#include <memory>

struct pcap;
struct pcap_dumper;

namespace scanloom
{
/** An IPv4 packet of 65535 bytes without the IP and UDP headers. */
constexpr std::size_t kLargestUdpPayload = 65507;

/**
 * Writes datagrams to a pcap file with nanosecond stamps: Ethernet, IPv4 or IPv6 like the source address, UDP with
 * checksum. Long datagrams are not split into fragments. The destination address, which a Datagram does not have, is
 * broadcast. Only flush() and close() make sure that everything is written.
 */
class CaptureWriter
{
 public:
  /** Creates or overwrites the file. Throws std::runtime_error if it cannot be created. */
  explicit CaptureWriter(const std::filesystem::path&);

  /** Closes without reporting errors: call close() before. */
  ~CaptureWriter() = default;

  /**
   * Throws std::invalid_argument for a payload above kLargestUdpPayload or a stamp outside of 1970 to 2106 (pcap has 32
   * bits of seconds), std::runtime_error if the disk is full.
   */
  void write(const DatagramView&);

  /** Passes all that was written to the operating system. Throws std::runtime_error if that fails. */
  void flush();

  /** flush(), then closes the file. No write may follow. */
  void close();

 private:
  struct CloseCapture
  {
    void operator()(pcap*) const;
  };
  struct CloseDump
  {
    void operator()(pcap_dumper*) const;
  };

  std::filesystem::path path_;
  std::unique_ptr<pcap, CloseCapture> capture_;
  std::unique_ptr<pcap_dumper, CloseDump> dump_;
  std::vector<std::uint8_t> frame_;
  std::uint16_t next_id_ = 0;  // of the IP packet
};
}  // namespace scanloom
