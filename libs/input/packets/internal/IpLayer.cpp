#include "input/packets/internal/IpLayer.h"

#include "input/packets/internal/NetworkBytes.h"

namespace scanloom
{
namespace
{
constexpr std::uint8_t kHopByHop = 0, kRouting = 43, kFragment = 44, kDestinationOptions = 60;  // IPv6 next headers

/** Position packets of old VLP-16s state the length of their lidar packets in IP, and the right one in UDP. */
bool isOldPosition(Bytes packet, std::size_t header, std::size_t stated)
{
  const bool fragment = (loadBigEndian<std::uint16_t>(packet, 6) & 0x3fffu) != 0;
  if (stated <= packet.size() || fragment || load<std::uint8_t>(packet, 9) != kUdp || packet.size() < header + 8)
    return false;
  return header + loadBigEndian<std::uint16_t>(packet, header + 4) <= packet.size();
}

IpContent contentOfV4(Bytes packet)
{
  const std::size_t header = 4u * (packet[0] & 0x0fu);
  if (header < 20) throw std::out_of_range("IPv4: header shorter than 20 bytes");
  // If the network card splits datagrams, captured packets have a length of 0.
  const std::size_t stated = loadBigEndian<std::uint16_t>(packet, 2);
  const std::size_t total = stated == 0 || isOldPosition(packet, header, stated) ? packet.size() : stated;
  if (total < header) throw std::out_of_range("IPv4: shorter than its header");
  const auto fragment = loadBigEndian<std::uint16_t>(packet, 6);

  IpContent content;
  content.id = loadBigEndian<std::uint16_t>(packet, 4);
  content.more_fragments = (fragment & 0x2000u) != 0;
  content.offset = 8u * (fragment & 0x1fffu);
  content.protocol = load<std::uint8_t>(packet, 9);
  content.source = IpAddress::fromBytes(packet.slice(12, 4));
  content.destination = IpAddress::fromBytes(packet.slice(16, 4));
  content.payload = packet.slice(header, total - header);
  return content;
}

IpContent contentOfV6(Bytes packet)
{
  IpContent content;
  content.protocol = load<std::uint8_t>(packet, 6);
  content.source = IpAddress::fromBytes(packet.slice(8, 16));
  content.destination = IpAddress::fromBytes(packet.slice(24, 16));
  content.payload = packet.slice(40, loadBigEndian<std::uint16_t>(packet, 4));
  skipExtensions(content.protocol, content.payload);
  if (content.protocol != kFragment) return content;

  const Bytes header = content.payload.slice(0, 8);
  const auto fragment = loadBigEndian<std::uint16_t>(header, 2);
  content.protocol = header[0];
  content.id = loadBigEndian<std::uint32_t>(header, 4);
  content.more_fragments = (fragment & 1u) != 0;
  content.offset = fragment & 0xfff8u;
  content.payload = dropFront(content.payload, 8);
  if (!content.isFragment()) skipExtensions(content.protocol, content.payload);
  return content;
}
}  // namespace

IpContent ipContentOf(Bytes packet)
{
  switch (load<std::uint8_t>(packet, 0) >> 4)
  {
    case 4:
      return contentOfV4(packet);
    case 6:
      return contentOfV6(packet);
    default:
      throw std::out_of_range("IP: version neither 4 nor 6");
  }
}

bool isExtension(std::uint8_t protocol)
{
  return protocol == kHopByHop || protocol == kRouting || protocol == kDestinationOptions;
}

void skipExtensions(std::uint8_t& protocol, Bytes& content)
{
  while (isExtension(protocol))
  {
    const std::size_t length = 8u * (load<std::uint8_t>(content, 1) + 1u);
    protocol = content[0];
    content = dropFront(content, length);
  }
}

UdpContent udpContentOf(Bytes datagram)
{
  const std::size_t length = loadBigEndian<std::uint16_t>(datagram, 4);
  if (length < 8) throw std::out_of_range("UDP: shorter than its header");
  return {loadBigEndian<std::uint16_t>(datagram, 0), loadBigEndian<std::uint16_t>(datagram, 2),
          datagram.slice(8, length - 8)};
}
}  // namespace scanloom
