#include "input/packets/internal/PcapngRecords.h"

#include "input/packets/internal/NetworkBytes.h"

#include <fmt/format.h>
#include <pcap/dlt.h>

#include <algorithm>
#include <array>

namespace scanloom
{
namespace
{
enum BlockType : std::uint32_t  // section 11.1 of the draft
{
  kInterface = 1,
  kObsoletePacket = 2,
  kSimplePacket = 3,
  kEnhancedPacket = 6,
  kSection = 0x0A0D0D0A,
};
constexpr std::uint16_t kEndOfOptions = 0, kResolution = 9, kOffset = 14;  // if_tsresol, if_tsoffset
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;
constexpr std::uint32_t kLargestBlock = 16 << 20;  // bytes, as libpcap has it
constexpr int kRawIp = 101;                        // LINKTYPE_RAW: the only readable one whose DLT_ value differs

constexpr std::uint8_t kMostDecimals = 19, kMostBits = 63;  // of a resolution whose units a std::uint64_t counts

constexpr std::uint64_t powerOfTen(int exponent) { return exponent == 0 ? 1 : 10 * powerOfTen(exponent - 1); }

/** Seconds since 1970 and nanoseconds of `units` of 10^-resolution or, with its highest bit set, 2^-resolution s. */
std::pair<std::uint64_t, std::uint64_t> secondsOf(std::uint64_t units, std::uint8_t resolution)
{
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  const int exponent = resolution & 0x7F;
  if (resolution & 0x80)
  {
    const std::uint64_t rest = units & ((std::uint64_t{1} << exponent) - 1);
    constexpr int kKept = 34;  // bits, so that the product fits 64
    const int dropped = std::max(0, exponent - kKept);
    return {units >> exponent, (rest >> dropped) * kNanoseconds >> (exponent - dropped)};
  }
  const std::uint64_t per_second = powerOfTen(exponent), rest = units % per_second;
  return {units / per_second, exponent <= 9 ? rest * powerOfTen(9 - exponent) : rest / powerOfTen(exponent - 9)};
}

std::optional<Timestamp> stampOf(std::uint64_t units, std::uint8_t resolution, std::int64_t offset_seconds)
{
  const auto [whole, rest] = secondsOf(units, resolution);
  const bool far_offset = offset_seconds < -kLatestSecond || offset_seconds > kLatestSecond;
  if (whole > static_cast<std::uint64_t>(kLatestSecond) || far_offset) return std::nullopt;
  const std::int64_t second = static_cast<std::int64_t>(whole) + offset_seconds;
  if (second < 0 || second > kLatestSecond) return std::nullopt;
  return Timestamp{std::chrono::seconds{second} + Duration{static_cast<std::int64_t>(rest)}};
}

/** Throws CutCapture if the file ends before. */
void readAll(CompressedFile& file, std::uint8_t* bytes, std::size_t count)
{
  if (file.readUpTo(bytes, count) == count) return;
  file.atEnd();  // throws if it is the compressed file that is cut
  throw CutCapture("the file ends inside a block");
}
}  // namespace

PcapngRecords::PcapngRecords(CompressedFile& file) : file_(file) { readSection(); }

std::optional<CaptureRecord> PcapngRecords::next()
try
{
  while (const auto type = nextBlock()) switch (*type)
    {
      case kInterface:
        addInterface();
        break;
      case kEnhancedPacket:
        return packet(field<std::uint32_t>(0));
      case kObsoletePacket:
        return packet(field<std::uint16_t>(0));
      case kSimplePacket:
        return simplePacket();
      default:  // names, statistics, comments
        break;
    }
  return std::nullopt;
}
catch (const std::out_of_range&)
{
  throw DamagedCapture("a block is shorter than its fields");
}

/** The type of the next block, whose body is read then; that of a section is read to its end, too. */
std::optional<std::uint32_t> PcapngRecords::nextBlock()
{
  std::array<std::uint8_t, 4> word{};
  const std::size_t got = file_.readUpTo(word.data(), word.size());
  if (got == 0 && file_.atEnd()) return std::nullopt;
  readAll(file_, word.data() + got, word.size() - got);
  const Bytes bytes(word.data(), word.size());
  if (load<std::uint32_t>(bytes, 0) == kSection)
  {
    readSection();
    return kSection;
  }
  const auto type = big_endian_ ? loadBigEndian<std::uint32_t>(bytes, 0) : load<std::uint32_t>(bytes, 0);
  readAll(file_, word.data(), word.size());
  readBody(big_endian_ ? loadBigEndian<std::uint32_t>(bytes, 0) : load<std::uint32_t>(bytes, 0), 8);
  return type;
}

/** The rest of a section's header behind its type. What follows has the byte order that its magic tells. */
void PcapngRecords::readSection()
{
  std::array<std::uint8_t, 8> words{};
  readAll(file_, words.data(), words.size());
  const Bytes bytes(words.data(), words.size());
  big_endian_ = loadBigEndian<std::uint32_t>(bytes, 4) == kByteOrderMagic;
  if (!big_endian_ && load<std::uint32_t>(bytes, 4) != kByteOrderMagic)
    throw DamagedCapture("a section without the magic that tells its byte order");
  readBody(big_endian_ ? loadBigEndian<std::uint32_t>(bytes, 0) : load<std::uint32_t>(bytes, 0), 12);
  interfaces_.clear();
}

/** Reads a block of `block_length` bytes, of which the first `bytes_before` have been read, with the length at its end.
 */
void PcapngRecords::readBody(std::uint32_t block_length, std::size_t bytes_before)
{
  if (block_length < bytes_before + 4 || block_length % 4 != 0 || block_length > kLargestBlock)
    throw DamagedCapture(fmt::format("a block of {} bytes", block_length));
  body_.resize(block_length - bytes_before);
  readAll(file_, body_.data(), body_.size());
  if (field<std::uint32_t>(body_.size() - 4) != block_length) throw DamagedCapture("a block whose two lengths differ");
  body_.resize(body_.size() - 4);
}

void PcapngRecords::addInterface()
{
  Interface interface;
  const int link_type = field<std::uint16_t>(0);
  interface.link_type = link_type == kRawIp ? DLT_RAW : link_type;
  interface.snap_length = field<std::uint32_t>(4);
  for (std::size_t at = 8; at + 4 <= body_.size();)
  {
    const auto code = field<std::uint16_t>(at), length = field<std::uint16_t>(at + 2);
    if (code == kEndOfOptions) break;
    if (code == kResolution) interface.resolution = field<std::uint8_t>(at + 4);
    if (code == kOffset) interface.offset_seconds = static_cast<std::int64_t>(field<std::uint64_t>(at + 4));
    at += 4 + (length + std::size_t{3}) / 4 * 4;
  }
  const int exponent = interface.resolution & 0x7F;
  if (exponent > (interface.resolution & 0x80 ? kMostBits : kMostDecimals))
    throw DamagedCapture(fmt::format("stamps of {}^-{} s", interface.resolution & 0x80 ? 2 : 10, exponent));
  interfaces_.push_back(interface);
}

/** Enhanced and obsolete packets differ in the number of the interface alone. */
CaptureRecord PcapngRecords::packet(std::size_t number) const
{
  const Interface& interface = interfaceAt(number);
  const std::uint64_t units = std::uint64_t{field<std::uint32_t>(4)} << 32 | field<std::uint32_t>(8);
  return {interface.link_type, stampOf(units, interface.resolution, interface.offset_seconds), field<std::uint32_t>(16),
          Bytes(body_).slice(20, field<std::uint32_t>(12))};
}

CaptureRecord PcapngRecords::simplePacket() const
{
  const Interface& interface = interfaceAt(0);
  const auto length = field<std::uint32_t>(0);
  const std::uint32_t kept = interface.snap_length == 0 ? length : std::min(length, interface.snap_length);
  return {interface.link_type, Timestamp{}, length, Bytes(body_).slice(4, kept)};
}

const PcapngRecords::Interface& PcapngRecords::interfaceAt(std::size_t number) const
{
  if (number >= interfaces_.size()) throw DamagedCapture("a packet of an interface that is not described");
  return interfaces_[number];
}

/** Of the block's body, in the section's byte order. */
template <typename T>
T PcapngRecords::field(std::size_t offset) const
{
  return big_endian_ ? loadBigEndian<T>(body_, offset) : load<T>(body_, offset);
}
}  // namespace scanloom
