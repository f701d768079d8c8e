#include "input/packets/CaptureWriter.h"

#include "input/packets/internal/IpLayer.h"
#include "input/packets/internal/NetworkBytes.h"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr int kSnapLength = 262144;  // the most that libpcap accepts for Ethernet; longer than any datagram
constexpr std::uint8_t kHopLimit = 64;

/** Checksum of RFC 1071 before it is folded and inverted. `bytes` must begin at an even offset of the summed data. */
std::uint64_t sumOfWords(Bytes bytes)
{
  std::uint64_t sum = 0;
  std::size_t i = 0;
  for (; i + 1 < bytes.size(); i += 2) sum += static_cast<std::uint32_t>(bytes[i] << 8 | bytes[i + 1]);
  if (i < bytes.size()) sum += static_cast<std::uint32_t>(bytes[i] << 8);
  return sum;
}

std::uint16_t checksum(std::uint64_t sum)
{
  while (sum >> 16) sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

IpAddress broadcastFor(const IpAddress& source)
{
  return IpAddress::parse(source.isV4() ? "255.255.255.255" : "ff02::1");
}

void append(std::vector<std::uint8_t>& frame, Bytes bytes) { frame.insert(frame.end(), bytes.begin(), bytes.end()); }

void appendEthernet(std::vector<std::uint8_t>& frame, const IpAddress& source)
{
  frame.insert(frame.end(), 6, 0xff);  // broadcast
  frame.insert(frame.end(), 6, 0x00);
  appendBigEndian<std::uint16_t>(frame, source.isV4() ? 0x0800 : 0x86dd);
}

void appendV4(std::vector<std::uint8_t>& frame, const IpAddress& source, const IpAddress& destination,
              std::size_t content, std::uint16_t id)
{
  std::vector<std::uint8_t> header{0x45, 0};
  appendBigEndian(header, static_cast<std::uint16_t>(20 + content));
  appendBigEndian(header, id);
  appendBigEndian<std::uint16_t>(header, 0);  // not a fragment
  header.insert(header.end(), {kHopLimit, kUdp, 0, 0});
  append(header, source.wire());
  append(header, destination.wire());
  const std::uint16_t sum = checksum(sumOfWords(header));
  header[10] = static_cast<std::uint8_t>(sum >> 8);
  header[11] = static_cast<std::uint8_t>(sum);
  append(frame, header);
}

void appendV6(std::vector<std::uint8_t>& frame, const IpAddress& source, const IpAddress& destination,
              std::size_t content)
{
  appendBigEndian<std::uint32_t>(frame, 0x60000000);
  appendBigEndian(frame, static_cast<std::uint16_t>(content));
  frame.insert(frame.end(), {kUdp, kHopLimit});
  append(frame, source.wire());
  append(frame, destination.wire());
}

void appendUdp(std::vector<std::uint8_t>& frame, const DatagramView& datagram, const IpAddress& destination)
{
  const std::size_t begin = frame.size();
  const std::size_t length = 8 + datagram.payload.size();
  appendBigEndian(frame, datagram.source_port);
  appendBigEndian(frame, datagram.destination_port);
  appendBigEndian(frame, static_cast<std::uint16_t>(length));
  appendBigEndian<std::uint16_t>(frame, 0);
  append(frame, datagram.payload);

  const std::uint64_t pseudo_header =
      sumOfWords(datagram.source.wire()) + sumOfWords(destination.wire()) + kUdp + length;
  std::uint16_t sum = checksum(pseudo_header + sumOfWords({frame.data() + begin, length}));
  if (sum == 0) sum = 0xffff;  // 0 means no checksum (RFC 768)
  frame[begin + 6] = static_cast<std::uint8_t>(sum >> 8);
  frame[begin + 7] = static_cast<std::uint8_t>(sum);
}

pcap_pkthdr recordHeader(Timestamp received, std::size_t length)
{
  const auto whole = std::chrono::floor<std::chrono::seconds>(received.time_since_epoch());
  if (whole.count() < 0 || whole.count() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument(
        fmt::format("datagram received at {} ns: pcap stamps range from 1970 to 2106 only", nanoseconds(received)));
  pcap_pkthdr header{};
  header.ts.tv_sec = whole.count();
  header.ts.tv_usec = (received.time_since_epoch() - whole).count();  // nanoseconds: the file was opened for them
  header.caplen = header.len = static_cast<bpf_u_int32>(length);
  return header;
}
}  // namespace

void CaptureWriter::CloseCapture::operator()(pcap* capture) const { pcap_close(capture); }
void CaptureWriter::CloseDump::operator()(pcap_dumper* dump) const { pcap_dump_close(dump); }

CaptureWriter::CaptureWriter(const std::filesystem::path& path)
  : path_(path),
    capture_(pcap_open_dead_with_tstamp_precision(DLT_EN10MB, kSnapLength, PCAP_TSTAMP_PRECISION_NANO)),
    dump_(capture_ ? pcap_dump_open(capture_.get(), path.c_str()) : nullptr)
{
  if (!dump_)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", path.string(),
                                         capture_ ? pcap_geterr(capture_.get()) : "out of memory"));
}

void CaptureWriter::write(const DatagramView& datagram)
{
  if (!dump_) throw std::logic_error("CaptureWriter: write after close");
  if (datagram.payload.size() > kLargestUdpPayload)
    throw std::invalid_argument(
        fmt::format("datagram of {} bytes: UDP carries at most {}", datagram.payload.size(), kLargestUdpPayload));

  const IpAddress destination = broadcastFor(datagram.source);
  const std::size_t udp_length = 8 + datagram.payload.size();
  frame_.clear();
  appendEthernet(frame_, datagram.source);
  if (datagram.source.isV4())
    appendV4(frame_, datagram.source, destination, udp_length, next_id_++);
  else
    appendV6(frame_, datagram.source, destination, udp_length);
  appendUdp(frame_, datagram, destination);

  const pcap_pkthdr header = recordHeader(datagram.received, frame_.size());
  pcap_dump(reinterpret_cast<u_char*>(dump_.get()), &header, frame_.data());
  if (std::ferror(pcap_dump_file(dump_.get())))
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

void CaptureWriter::flush()
{
  if (pcap_dump_flush(dump_.get()) != 0)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

void CaptureWriter::close()
{
  if (!dump_) return;
  flush();
  dump_.reset();
}
}  // namespace scanloom
