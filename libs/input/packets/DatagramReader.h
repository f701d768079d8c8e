#pragma once
#include "input/packets/Datagram.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Counts of the records of a capture. */
struct CaptureCounters
{
  std::uint64_t records = 0;            // of a bag: messages
  std::uint64_t datagrams = 0;          // delivered
  std::uint64_t fragments_joined = 0;   // datagrams that were assembled from fragments
  std::uint64_t fragments_expired = 0;  // datagrams with a missing fragment
  std::uint64_t not_udp = 0;            // records: ARP, TCP, ICMP, ...; of a bag: messages without lidar packets
  std::uint64_t cut_short = 0;          // records that were captured incompletely (snap length)
  std::uint64_t malformed = 0;          // records with contradicting lengths or an impossible stamp
  bool truncated = false;               // the file ends inside a record; all before it was delivered
  std::vector<std::string> damages;     // where a file is damaged, and how to mend it; all before it was delivered
};

CaptureCounters operator+(const CaptureCounters&, const CaptureCounters&);

/** A recording of datagrams: a capture, or a bag. */
class DatagramReader
{
 public:
  virtual ~DatagramReader() = default;

  /** Replaces `datagram` by the next one, reusing its memory; false at the end. */
  virtual bool next(Datagram& datagram) = 0;

  virtual CaptureCounters counters() const = 0;

  /** Share of the bytes that were read, 0 to 1. */
  virtual double progress() const = 0;
};
}  // namespace scanloom
