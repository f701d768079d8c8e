#pragma once
#include "input/packets/DatagramReader.h"
#include "input/packets/internal/FragmentJoiner.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class CaptureRecords;
class CompressedFile;
struct CaptureRecord;

/**
 * The UDP datagrams of a pcap or pcapng file, plain or in gzip or zstd, in the file's order, with stamps in
 * nanoseconds. Link types: Ethernet with or without VLAN tags, Linux cooked, raw IP, loopback; the interfaces of a
 * pcapng may differ, and records of those that carry no IP count as no UDP. IPv4 and IPv6; fragments are joined.
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
   * stamp of the fragment that completed it. A damaged file ends before the damage, which the counters tell. Throws
   * std::runtime_error at the end of a pcapng none of whose interfaces carries IP.
   */
  bool next(Datagram& datagram) override;

  CaptureCounters counters() const override;

  double progress() const override;

 private:
  std::optional<CaptureRecord> nextRecord();
  bool readDatagram(const CaptureRecord&, Datagram&);

  std::filesystem::path path_;
  std::unique_ptr<CompressedFile> file_;
  std::unique_ptr<CaptureRecords> records_;
  double file_size_ = 0;          // bytes; 0 for a pipe
  std::uint64_t bytes_read_ = 0;  // of frames, for the progress
  std::uint64_t other_links_ = 0;
  int other_link_type_ = 0;
  bool ended_ = false;
  FragmentJoiner joiner_;
  std::vector<std::uint8_t> joined_;
  CaptureCounters counters_;
};
}  // namespace scanloom
