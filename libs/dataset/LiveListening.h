#pragma once
#include "dataset/RigEvidence.h"

#include <functional>

namespace scanloom
{
/**
 * Gives the listener what reaches the rig's ports, in the order of the kernel's stamps, for so long, or until `goOn`
 * (asked ten times a second) says no; then what the sockets counted. Throws what UdpReceiver throws.
 */
void listenLive(const Rig&, Duration, RigListener&, const std::function<bool()>& goOn);
}  // namespace scanloom
