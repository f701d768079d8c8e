#include "input/packets/CaptureReader.h"

#include "base/formats/CompressedFile.h"
#include "input/packets/describeFile.h"
#include "input/packets/internal/LinkLayer.h"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <utility>

namespace scanloom
{
/** A capture in gzip or zstd, for libpcap to read. */
struct PackedCapture
{
  explicit PackedCapture(const std::filesystem::path& path) : file(path) {}

  CompressedFile file;
  std::string damage;  // that ended the reading; empty if none did
};

namespace
{
/** libpcap has no code for a missing end, but all its messages about one begin like this. */
bool saysTruncated(const std::string& message) { return message.rfind("truncated", 0) == 0; }

// Year 2115. Differences of stamps up to here cannot overflow.
constexpr std::int64_t kLatestSecond = 24LL * 3600 * 365 * 145;

/** Throws std::out_of_range for an impossible stamp. */
Timestamp stampOf(const pcap_pkthdr& record)
{
  if (record.ts.tv_sec < 0 || record.ts.tv_sec > kLatestSecond) throw std::out_of_range("stamp");
  // The file was opened for nanoseconds: libpcap puts them into tv_usec.
  return Timestamp{std::chrono::seconds{record.ts.tv_sec} + Duration{record.ts.tv_usec}};
}

/** What libpcap calls to read; no exception may pass through it. */
ssize_t readPacked(void* cookie, char* bytes, std::size_t count)
{
  auto* packed = static_cast<PackedCapture*>(cookie);
  try
  {
    const std::size_t got = packed->file.readUpTo(bytes, count);
    if (got < count) packed->file.atEnd();  // throws if the file is cut
    return static_cast<ssize_t>(got);
  }
  catch (const std::exception& damage)
  {
    packed->damage = damage.what();
    return 0;
  }
}

/** Null if the file is not compressed: libpcap opens it by itself, also a pipe. */
std::unique_ptr<PackedCapture> openPacked(const std::filesystem::path& path)
{
  return isCompressed(path) ? std::make_unique<PackedCapture>(path) : nullptr;
}

pcap* openAs(const std::filesystem::path& path, PackedCapture* packed, char* error)
{
  if (!packed) return pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO, error);
  cookie_io_functions_t functions{};
  functions.read = &readPacked;
  std::FILE* file = fopencookie(packed, "rb", functions);
  if (!file) throw std::bad_alloc();
  pcap* capture = pcap_fopen_offline_with_tstamp_precision(file, PCAP_TSTAMP_PRECISION_NANO, error);
  if (!capture) std::fclose(file);
  return capture;
}

pcap* open(const std::filesystem::path& path, PackedCapture* packed)
{
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  if (pcap* capture = openAs(path, packed, error.data())) return capture;
  throw std::runtime_error(fmt::format("{}: {}; a pcap or pcapng capture of UDP packets is needed ({})", path.string(),
                                       describeFile(path), error.data()));
}
}  // namespace

CaptureCounters operator+(const CaptureCounters& a, const CaptureCounters& b)
{
  std::vector<std::string> damages = a.damages;
  damages.insert(damages.end(), b.damages.begin(), b.damages.end());
  return {a.records + b.records,
          a.datagrams + b.datagrams,
          a.fragments_joined + b.fragments_joined,
          a.fragments_expired + b.fragments_expired,
          a.not_udp + b.not_udp,
          a.cut_short + b.cut_short,
          a.malformed + b.malformed,
          a.truncated || b.truncated,
          std::move(damages)};
}

void CaptureReader::Close::operator()(pcap* capture) const { pcap_close(capture); }

CaptureReader::CaptureReader(const std::filesystem::path& path)
  : path_(path),
    packed_(openPacked(path)),
    capture_(open(path, packed_.get())),
    link_type_(pcap_datalink(capture_.get()))
{
  if (!isKnownLinkType(link_type_))
  {
    const char* name = pcap_datalink_val_to_name(link_type_);
    throw std::runtime_error(fmt::format(
        "{}: a capture of link type {} ({}); readable are Ethernet, Linux cooked (SLL, SLL2), raw IP and loopback",
        path.string(), name ? name : "unknown", link_type_));
  }
  std::error_code not_a_file;  // a pipe has no size: its progress stays 0
  const auto size = std::filesystem::file_size(path, not_a_file);
  if (!not_a_file) file_size_ = static_cast<double>(size);
}

CaptureReader::CaptureReader(CaptureReader&&) noexcept = default;
CaptureReader::~CaptureReader() = default;

bool CaptureReader::next(Datagram& datagram)
{
  while (nextRecord())
  {
    ++counters_.records;
    try
    {
      if (record_->caplen < record_->len)
        ++counters_.cut_short;
      else if (readDatagram({frame_, record_->caplen}, datagram))
        return true;
    }
    catch (const std::out_of_range&)
    {
      ++counters_.malformed;
    }
  }
  joiner_.finish();
  return false;
}

CaptureCounters CaptureReader::counters() const
{
  CaptureCounters counters = counters_;
  counters.fragments_joined = joiner_.joined();
  counters.fragments_expired = joiner_.lost();
  return counters;
}

double CaptureReader::progress() const
{
  if (file_size_ == 0) return 0;
  const auto read = packed_ ? static_cast<double>(packed_->file.bytesRead())
                            : static_cast<double>(std::ftell(pcap_file(capture_.get())));
  return read / file_size_;
}

bool CaptureReader::nextRecord()
{
  if (counters_.truncated || !counters_.damages.empty()) return false;
  pcap_pkthdr* record = nullptr;
  const int outcome = pcap_next_ex(capture_.get(), &record, &frame_);
  record_ = record;
  if (outcome == 1) return true;
  if (packed_ && !packed_->damage.empty())
  {
    counters_.damages.push_back(fmt::format("{}; it was read up to record {}", packed_->damage, counters_.records));
    return false;
  }
  if (outcome == PCAP_ERROR_BREAK) return false;

  const std::string error = pcap_geterr(capture_.get());
  if (saysTruncated(error))
    counters_.truncated = true;
  else
    counters_.damages.push_back(
        fmt::format("{}: damaged after record {}: {}; 'editcap -r {} good.pcap 1-{}' keeps the part before",
                    path_.string(), counters_.records, error, path_.string(), counters_.records));
  return false;
}

/** False if the record completes no datagram: not UDP, or a fragment with others still missing. */
bool CaptureReader::readDatagram(Bytes frame, Datagram& datagram)
{
  const Timestamp received = stampOf(*record_);
  const std::optional<Bytes> packet = ipPacketOf(link_type_, frame);
  IpContent content = packet ? ipContentOf(*packet) : IpContent{};
  const bool may_be_udp = content.protocol == kUdp || (content.isFragment() && isExtension(content.protocol));
  if (may_be_udp && content.isFragment())
  {
    if (!joiner_.add(received, content, joined_)) return false;
    content.payload = joined_;
    skipExtensions(content.protocol, content.payload);
  }
  if (content.protocol != kUdp)
  {
    ++counters_.not_udp;
    return false;
  }

  const UdpContent udp = udpContentOf(content.payload);
  datagram.received = received;
  datagram.source = content.source;
  datagram.source_port = udp.source_port;
  datagram.destination_port = udp.destination_port;
  datagram.payload.assign(udp.payload.begin(), udp.payload.end());
  ++counters_.datagrams;
  return true;
}
}  // namespace scanloom
