/** IP and UDP headers (RFC 791, 8200, 768). Every function throws std::out_of_range on lengths that contradict the
 * bytes. */
#pragma once
#include "core/Bytes.h"
#include "source/IpAddress.h"

#include <optional>

namespace scanloom
{
constexpr std::uint8_t kUdp = 17;

/** The content of one IP packet: a whole datagram or a fragment of one. Views into the packet. */
struct IpContent
{
  IpAddress source, destination;
  std::uint8_t protocol = 0;  // of the content; of a fragment, what its datagram begins with
  std::uint32_t id = 0;       // the fragments of one datagram share it
  std::uint32_t offset = 0;   // bytes of the datagram before this fragment
  bool more_fragments = false;
  Bytes payload;

  bool isFragment() const { return offset > 0 || more_fragments; }
};

/** IPv4 or IPv6, by the version in the first byte. Padding behind the packet is cut off. */
IpContent ipContentOf(Bytes packet);

/** An IPv6 extension header, behind which the content's own protocol is named. */
bool isExtension(std::uint8_t protocol);

/** Skips IPv6 extension headers in front of the content; an unfragmented or a joined datagram is then `protocol`. */
void skipExtensions(std::uint8_t& protocol, Bytes& content);

struct UdpContent
{
  std::uint16_t source_port = 0, destination_port = 0;
  Bytes payload;
};

/** The checksum is not looked at: capture tools rewrite addresses, and sending hosts leave it to the network card. */
UdpContent udpContentOf(Bytes datagram);
}  // namespace scanloom
