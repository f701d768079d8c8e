#include "input/packets/internal/CaptureRecords.h"

#include "input/packets/internal/LinkLayer.h"
#include "input/packets/internal/PcapngRecords.h"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace scanloom
{
namespace
{
/** libpcap has no code for a missing end, but all its messages about one begin like this. */
bool saysTruncated(const std::string& message) { return message.rfind("truncated", 0) == 0; }

/**
 * The file was opened for nanoseconds: libpcap puts them into tv_usec. `per_unit` is 1000 where the file says
 * microseconds and holds nanoseconds.
 */
std::optional<Timestamp> stampOf(const pcap_pkthdr& record, std::int64_t per_unit)
{
  if (record.ts.tv_sec < 0 || record.ts.tv_sec > kLatestSecond) return std::nullopt;
  return Timestamp{std::chrono::seconds{record.ts.tv_sec} + Duration{record.ts.tv_usec / per_unit}};
}

constexpr std::uint64_t kMostDamaged = 10;  // records that show nanoseconds: with more, the whole file holds them

class PcapRecords : public CaptureRecords
{
 public:
  PcapRecords(CompressedFile& file, std::vector<char> magic)
    : file_(file), magic_(std::move(magic)), capture_(open(), &pcap_close), link_type_(pcap_datalink(capture_.get()))
  {
    if (!isKnownLinkType(link_type_)) throw OtherLinkType(link_type_);
  }

  std::optional<CaptureRecord> next() override
  {
    pcap_pkthdr* record = nullptr;
    const std::uint8_t* frame = nullptr;
    const int outcome = pcap_next_ex(capture_.get(), &record, &frame);
    if (outcome == 1)
    {
      constexpr std::int64_t kSecond = 1'000'000'000;  // ns: no fraction of one has more
      const bool in_nanoseconds = record->ts.tv_usec >= kSecond;
      in_nanoseconds_ += in_nanoseconds;
      const std::int64_t per_unit = in_nanoseconds || in_nanoseconds_ > kMostDamaged ? 1000 : 1;
      return CaptureRecord{link_type_, stampOf(*record, per_unit), record->len, {frame, record->caplen}};
    }
    if (fault_) std::rethrow_exception(fault_);
    if (outcome == PCAP_ERROR_BREAK) return std::nullopt;
    const std::string error = pcap_geterr(capture_.get());
    if (saysTruncated(error)) throw CutCapture(error);
    throw DamagedCapture(error);
  }

 private:
  pcap_t* open()
  {
    cookie_io_functions_t functions{};
    functions.read = [](void* self, char* bytes, std::size_t count)
    { return static_cast<PcapRecords*>(self)->read(bytes, count); };
    std::FILE* stream = fopencookie(this, "rb", functions);
    if (!stream) throw std::bad_alloc();
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    pcap_t* capture = pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error.data());
    if (capture) return capture;
    std::fclose(stream);
    throw std::runtime_error(error.data());
  }

  /** What libpcap calls to read; no exception may pass through it. */
  ssize_t read(char* bytes, std::size_t count)
  {
    const std::size_t ahead = std::min(count, magic_.size());
    std::copy_n(magic_.begin(), ahead, bytes);
    magic_.erase(magic_.begin(), magic_.begin() + static_cast<std::ptrdiff_t>(ahead));
    try
    {
      const std::size_t got = ahead + file_.readUpTo(bytes + ahead, count - ahead);
      if (got < count) file_.atEnd();  // throws if the compressed file is cut
      return static_cast<ssize_t>(got);
    }
    catch (const std::runtime_error&)
    {
      fault_ = std::current_exception();
      return 0;
    }
  }

  CompressedFile& file_;
  std::vector<char> magic_;   // read from the file, not yet by libpcap
  std::exception_ptr fault_;  // that ended the reading
  std::unique_ptr<pcap_t, void (*)(pcap_t*)> capture_;
  int link_type_;
  std::uint64_t in_nanoseconds_ = 0;  // records of a file of microseconds that show nanoseconds
};

std::string nameOf(int link_type)
{
  const char* name = pcap_datalink_val_to_name(link_type);
  return name ? name : "unknown";
}
}  // namespace

OtherLinkType::OtherLinkType(int link_type)
  : std::runtime_error(fmt::format(
        "a capture of link type {} ({}); readable are Ethernet, Linux cooked (SLL, SLL2), raw IP and loopback",
        nameOf(link_type), link_type))
{
}

std::unique_ptr<CaptureRecords> recordsOf(CompressedFile& file)
{
  std::vector<char> magic(4);
  magic.resize(file.readUpTo(magic.data(), magic.size()));
  if (magic == kPcapngMagic) return std::make_unique<PcapngRecords>(file);
  return std::make_unique<PcapRecords>(file, std::move(magic));
}
}  // namespace scanloom
