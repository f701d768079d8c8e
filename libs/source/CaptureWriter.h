#pragma once
#include "source/Datagram.h"

#include <filesystem>
#include <memory>

struct pcap;
struct pcap_dumper;

namespace scanloom
{
/** 65535 bytes of IPv4 packet less the IP and UDP headers. */
constexpr std::size_t kLargestUdpPayload = 65507;

/**
 * Writes datagrams as a pcap file with nanosecond stamps: Ethernet, IPv4 or IPv6 as the source address is, UDP with
 * checksum; one frame per datagram however long, as a capture shows it that was taken before the network card split it.
 * The destination, which a Datagram does not name, is broadcast (as lidars do by default).
 * Nothing is safe on disk before flush() or close() returned.
 */
class CaptureWriter
{
 public:
  /** Replaces the file; throws std::runtime_error if it cannot be created. */
  explicit CaptureWriter(const std::filesystem::path&);

  /** Closes, but cannot tell a failure: call close() where it matters. */
  ~CaptureWriter() = default;

  /**
   * Throws std::invalid_argument for a payload above kLargestUdpPayload or a stamp outside of 1970 to 2106 (pcap has 32
   * bits of seconds), std::runtime_error if the disk is full.
   */
  void write(const DatagramView&);

  /** Hands all that was written to the operating system; throws std::runtime_error if it refuses. */
  void flush();

  /** flush(), then closes: no write may follow. */
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
