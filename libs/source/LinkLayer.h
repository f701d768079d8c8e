/** The frames of a capture: what lies around the IP packet (tcpdump.org/linktypes.html). */
#pragma once
#include "core/Bytes.h"

#include <optional>

namespace scanloom
{
/** Ethernet, Linux cooked (SLL and SLL2), raw IP, BSD loopback. `link_type` is libpcap's DLT_ value. */
bool isKnownLinkType(int link_type);

/**
 * The frame without its link header and VLAN tags (802.1Q, 802.1ad); nothing if it carries no IP.
 * Throws std::out_of_range if the frame ends inside a header.
 */
std::optional<Bytes> ipPacketOf(int link_type, Bytes frame);
}  // namespace scanloom
