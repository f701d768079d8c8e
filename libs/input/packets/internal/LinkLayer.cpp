#include "input/packets/internal/LinkLayer.h"

#include "input/packets/internal/NetworkBytes.h"

#include <pcap/pcap.h>

namespace scanloom
{
namespace
{
constexpr std::uint16_t kIpV4 = 0x0800, kIpV6 = 0x86dd;  // EtherTypes
constexpr std::uint16_t kVlan = 0x8100, kServiceVlan = 0x88a8, kOldQinQ = 0x9100;

/** `payload` follows an EtherType. A VLAN tag is two bytes and the next EtherType. */
std::optional<Bytes> ipBehind(std::uint16_t ether_type, Bytes payload)
{
  while (ether_type == kVlan || ether_type == kServiceVlan || ether_type == kOldQinQ)
  {
    ether_type = loadBigEndian<std::uint16_t>(payload, 2);
    payload = dropFront(payload, 4);
  }
  if (ether_type != kIpV4 && ether_type != kIpV6) return std::nullopt;
  return payload;
}

/** The address family before the packet has the byte order of the capturing machine; IPv6 differs between BSDs. */
bool isLoopbackOfIp(Bytes frame)
{
  const auto little = load<std::uint32_t>(frame, 0);
  const auto big = loadBigEndian<std::uint32_t>(frame, 0);
  for (const std::uint32_t family : {2, 10, 24, 28, 30})
    if (little == family || big == family) return true;
  return false;
}
}  // namespace

bool isKnownLinkType(int link_type)
{
  switch (link_type)
  {
    case DLT_EN10MB:
    case DLT_LINUX_SLL:
    case DLT_LINUX_SLL2:
    case DLT_RAW:
    case DLT_IPV4:
    case DLT_IPV6:
    case DLT_NULL:
    case DLT_LOOP:
      return true;
    default:
      return false;
  }
}

std::optional<Bytes> ipPacketOf(int link_type, Bytes frame)
{
  switch (link_type)
  {
    case DLT_EN10MB:
      return ipBehind(loadBigEndian<std::uint16_t>(frame, 12), dropFront(frame, 14));
    case DLT_LINUX_SLL:
      return ipBehind(loadBigEndian<std::uint16_t>(frame, 14), dropFront(frame, 16));
    case DLT_LINUX_SLL2:
      return ipBehind(loadBigEndian<std::uint16_t>(frame, 0), dropFront(frame, 20));
    case DLT_NULL:
    case DLT_LOOP:
      return isLoopbackOfIp(frame) ? std::optional(dropFront(frame, 4)) : std::nullopt;
    default:
      return frame;
  }
}
}  // namespace scanloom
