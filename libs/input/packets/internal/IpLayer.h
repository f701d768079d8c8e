/** IP and UDP headers (RFC 791, 8200, 768). All functions throw std::out_of_range if lengths contradict the bytes. */
#pragma once
#include "base/core/Bytes.h"
#include "input/packets/IpAddress.h"

#include <optional>

namespace scanloom
{
constexpr std::uint8_t kUdp = 17;

/** The content of an IP packet: a whole datagram or a fragment. Its payload is a view into the packet. */
struct IpContent
{
  IpAddress source, destination;
  std::uint8_t protocol = 0;  // of the content; in a fragment, of the start of its datagram
  std::uint32_t id = 0;       // the same in all fragments of a datagram
  std::uint32_t offset = 0;   // bytes of the datagram before this fragment
  bool more_fragments = false;
  Bytes payload;

  bool isFragment() const { return offset > 0 || more_fragments; }
};

/** Reads IPv4 or IPv6, as the first byte tells. Padding behind the packet is removed. */
IpContent ipContentOf(Bytes packet);

/** Whether `protocol` is an IPv6 extension header. */
bool isExtension(std::uint8_t protocol);

/** Removes IPv6 extension headers from the front of `content` and sets `protocol` to that of the rest. */
void skipExtensions(std::uint8_t& protocol, Bytes& content);

struct UdpContent
{
  std::uint16_t source_port = 0, destination_port = 0;
  Bytes payload;
};

/** The checksum is not checked: in captures it is often wrong (rewritten addresses, computed by the network card). */
UdpContent udpContentOf(Bytes datagram);
}  // namespace scanloom
