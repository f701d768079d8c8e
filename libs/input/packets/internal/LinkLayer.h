/** Link layers of captures (tcpdump.org/linktypes.html): the IP packet in a frame. */
#pragma once
#include "base/core/Bytes.h"

#include <optional>

namespace scanloom
{
/** Whether it is Ethernet, Linux cooked (SLL, SLL2), raw IP or BSD loopback. `link_type` is libpcap's DLT_ value. */
bool isKnownLinkType(int link_type);

/**
 * The frame without link header and VLAN tags (802.1Q, 802.1ad); nothing if it contains no IP packet. Throws
 * std::out_of_range if the frame ends inside a header.
 */
std::optional<Bytes> ipPacketOf(int link_type, Bytes frame);
}  // namespace scanloom
