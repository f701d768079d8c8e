/** Records of capture files, before any of their bytes is understood: pcap by libpcap, pcapng by a reader of its own.
 */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"
#include "base/formats/CompressedFile.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

namespace scanloom
{
struct CaptureRecord
{
  int link_type = 0;               // libpcap's DLT_ value
  std::optional<Timestamp> stamp;  // nothing if it is before 1970 or after 2115
  std::size_t length = 0;          // bytes on the wire; the frame has fewer if the snapshot length cut it
  Bytes frame;                     // valid until the next record is read
};

/** The file ends inside a record. */
struct CutCapture : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** The file contradicts itself; the message says in what. */
struct DamagedCapture : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** No record of the file can carry IP; the message names the link type. */
struct OtherLinkType : std::runtime_error
{
  explicit OtherLinkType(int link_type);
};

class CaptureRecords
{
 public:
  virtual ~CaptureRecords() = default;

  /** Nothing at the end. Throws CutCapture, DamagedCapture and what CompressedFile throws; nothing follows then. */
  virtual std::optional<CaptureRecord> next() = 0;
};

/** The year 2115. Differences of stamps up to here cannot overflow. */
constexpr std::int64_t kLatestSecond = 24LL * 3600 * 365 * 145;

/**
 * `file`, at its first byte, must outlive the result; a pipe will do. Throws std::runtime_error if it is neither pcap
 * nor pcapng, and OtherLinkType for a pcap of one that carries no IP.
 */
std::unique_ptr<CaptureRecords> recordsOf(CompressedFile& file);
}  // namespace scanloom
