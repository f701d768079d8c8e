#pragma once
#include "input/packets/DatagramReader.h"
#include "input/packets/internal/FragmentJoiner.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct pcap;
struct pcap_pkthdr;

namespace scanloom
{
struct PackedCapture;

/**
 * The UDP datagrams of a pcap or pcapng file, plain or in gzip or zstd, in the file's order, with stamps in
 * nanoseconds. Link types: Ethernet with or without VLAN tags, Linux cooked, raw IP, loopback. IPv4 and IPv6; fragments
 * are joined.
 */
class CaptureReader : public DatagramReader
{
 public:
  /** Throws std::runtime_error if the file cannot be read or is no capture; the error tells what it is. */
  explicit CaptureReader(const std::filesystem::path&);
  CaptureReader(CaptureReader&&) noexcept;
  ~CaptureReader() override;

  /**
   * Replaces `datagram` by the next one, reusing its memory; false at the end of the file. A joined datagram gets the
   * stamp of the fragment that completed it. A damaged file ends before the damage, which the counters tell.
   */
  bool next(Datagram& datagram) override;

  CaptureCounters counters() const override;

  double progress() const override;

 private:
  struct Close
  {
    void operator()(pcap*) const;
  };

  bool nextRecord();
  bool readDatagram(Bytes frame, Datagram&);

  std::filesystem::path path_;
  std::unique_ptr<PackedCapture> packed_;  // that capture_ reads; null if the file is not compressed
  std::unique_ptr<pcap, Close> capture_;
  int link_type_ = 0;
  double file_size_ = 0;
  const pcap_pkthdr* record_ = nullptr;  // owned by libpcap, like frame_; valid until the next record is read
  const std::uint8_t* frame_ = nullptr;
  FragmentJoiner joiner_;
  std::vector<std::uint8_t> joined_;
  CaptureCounters counters_;
};
}  // namespace scanloom
