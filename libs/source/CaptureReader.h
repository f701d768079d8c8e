#pragma once
#include "source/Datagram.h"
#include "source/FragmentJoiner.h"

#include <filesystem>
#include <memory>
#include <optional>

struct pcap;
struct pcap_pkthdr;

namespace scanloom
{
/** What became of the records of a capture. */
struct CaptureCounters
{
  std::uint64_t records = 0;
  std::uint64_t datagrams = 0;          // delivered
  std::uint64_t fragments_joined = 0;   // of the datagrams: how many were put together from fragments
  std::uint64_t fragments_expired = 0;  // datagrams of which a fragment never came
  std::uint64_t not_udp = 0;            // records: ARP, TCP, ICMP, ...
  std::uint64_t cut_short = 0;          // records that the capture's own snap length cut off
  std::uint64_t malformed = 0;          // records whose lengths contradict each other, or of no possible time
  bool truncated = false;               // the file ends inside a record: everything before it was delivered
};

CaptureCounters operator+(const CaptureCounters&, const CaptureCounters&);

/**
 * The UDP datagrams of a pcap or pcapng file in the file's order, stamped to the nanosecond: over Ethernet with or
 * without VLAN tags, Linux cooked, raw IP or loopback; IPv4 and IPv6, fragments joined.
 */
class CaptureReader
{
 public:
  /** Throws std::runtime_error if the file cannot be read or is no capture, and says what it is instead. */
  explicit CaptureReader(const std::filesystem::path&);

  /**
   * Replaces `datagram` by the next one, reusing its memory; false at the end of the file. A joined datagram bears the
   * stamp of the fragment that completed it. Throws std::runtime_error where the file is damaged other than by its end.
   */
  bool next(Datagram& datagram);

  CaptureCounters counters() const;

  /** Share of the file's bytes that were read, 0 to 1. */
  double progress() const;

 private:
  struct Close
  {
    void operator()(pcap*) const;
  };

  bool nextRecord();
  bool readDatagram(Bytes frame, Datagram&);

  std::filesystem::path path_;
  std::unique_ptr<pcap, Close> capture_;
  int link_type_ = 0;
  double file_size_ = 0;
  const pcap_pkthdr* record_ = nullptr;  // owned by libpcap, as is frame_, until the next record is read
  const std::uint8_t* frame_ = nullptr;
  FragmentJoiner joiner_;
  std::vector<std::uint8_t> joined_;
  CaptureCounters counters_;
};
}  // namespace scanloom
