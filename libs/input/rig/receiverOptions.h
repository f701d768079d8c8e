#pragma once
#include "input/packets/UdpReceiver.h"
#include "input/rig/Rig.h"

namespace scanloom
{
/** The ports of a rig's lidars, and from which addresses each is received. */
UdpReceiverOptions receiverOptions(const Rig&);
}  // namespace scanloom
