/** Captures written byte by byte from the RFCs and tcpdump.org/linktypes.html, without code of CaptureWriter. */
#pragma once
#include "base/core/Time.h"
#include "support/TemporaryFolder.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace scanloom
{
using ByteVector = std::vector<std::uint8_t>;

inline ByteVector operator+(ByteVector a, const ByteVector& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline ByteVector be16(unsigned v) { return {static_cast<std::uint8_t>(v >> 8), static_cast<std::uint8_t>(v)}; }
inline ByteVector be32(std::uint32_t v) { return be16(v >> 16) + be16(v & 0xffff); }

/** `size` bytes that differ by place and by seed. */
inline ByteVector content(std::size_t size, unsigned seed = 0)
{
  ByteVector bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + (i >> 8) * 13 + seed * 101);
  return bytes;
}

/** A UDP datagram without checksum, from port 4000. */
inline ByteVector udp(unsigned destination_port, const ByteVector& payload)
{
  return be16(4000) + be16(destination_port) + be16(static_cast<unsigned>(8 + payload.size())) + be16(0) + payload;
}

struct FragmentOf
{
  unsigned id = 1;
  std::size_t offset = 0;
  bool more = false;
};

/** From 10.0.0.1 to 10.0.0.2, checksum left 0. */
inline ByteVector ipv4Packet(const ByteVector& payload, FragmentOf f = {}, std::uint8_t protocol = 17)
{
  return ByteVector{0x45, 0} + be16(static_cast<unsigned>(20 + payload.size())) + be16(f.id) +
         be16(static_cast<unsigned>(f.offset / 8 | (f.more ? 0x2000 : 0))) + ByteVector{64, protocol, 0, 0} +
         ByteVector{10, 0, 0, 1, 10, 0, 0, 2} + payload;
}

/** From fe80::1 to fe80::2; `next` is the first header behind the fixed one. */
inline ByteVector ipv6Packet(const ByteVector& payload, std::uint8_t next = 17)
{
  ByteVector address{0xfe, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  ByteVector packet = ByteVector{0x60, 0, 0, 0} + be16(static_cast<unsigned>(payload.size())) + ByteVector{next, 64};
  packet = packet + address;
  address.back() = 2;
  return packet + address + payload;
}
inline ByteVector ipv6Fragment(const ByteVector& piece, FragmentOf f, std::uint8_t protocol = 17)
{
  const ByteVector header =
      ByteVector{protocol, 0} + be16(static_cast<unsigned>(f.offset | (f.more ? 1 : 0))) + be32(f.id);
  return ipv6Packet(header + piece, 44);
}

inline ByteVector ethernet(unsigned ether_type, const ByteVector& packet)
{
  return ByteVector(12, 0x02) + be16(ether_type) + packet;
}
inline ByteVector ethernet(const ByteVector& ipv4_packet) { return ethernet(0x0800, ipv4_packet); }

/** The IPv4 packets of one datagram cut into pieces of `size` bytes (a multiple of 8). */
inline std::vector<ByteVector> ipv4Fragments(const ByteVector& datagram, std::size_t size, unsigned id)
{
  std::vector<ByteVector> packets;
  for (std::size_t at = 0; at < datagram.size(); at += size)
  {
    const std::size_t end = std::min(at + size, datagram.size());
    packets.push_back(
        ipv4Packet(ByteVector(datagram.begin() + static_cast<long>(at), datagram.begin() + static_cast<long>(end)),
                   {id, at, end < datagram.size()}));
  }
  return packets;
}

/** A nanosecond pcap file in a folder of its own, removed in the end. */
class HandmadeCapture
{
 public:
  explicit HandmadeCapture(std::uint32_t link_type = 1)
  {
    write32(0xa1b23c4d);
    write32(0x00040002);  // version 2.4
    write32(0);
    write32(0);
    write32(262144);
    write32(link_type);
  }
  HandmadeCapture& add(const ByteVector& frame, Duration at = 1s) { return add(frame, at, frame.size()); }
  HandmadeCapture& add(const ByteVector& frame, Duration at, std::size_t original_length)
  {
    write32(static_cast<std::uint32_t>(at / 1s));
    write32(static_cast<std::uint32_t>((at % 1s).count()));
    write32(static_cast<std::uint32_t>(frame.size()));
    write32(static_cast<std::uint32_t>(original_length));
    bytes_ = bytes_ + frame;
    return *this;
  }

  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path file(std::size_t length = static_cast<std::size_t>(-1)) const
  {
    const auto path = folder_ / "capture.pcap";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes_.data()), static_cast<long>(std::min(length, bytes_.size())));
    return path;
  }
  std::size_t size() const { return bytes_.size(); }

 private:
  void write32(std::uint32_t v)  // in this machine's order, as the magic number tells
  {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&v);
    bytes_.insert(bytes_.end(), begin, begin + 4);
  }

  TemporaryFolder folder_;
  ByteVector bytes_;
};
}  // namespace scanloom
