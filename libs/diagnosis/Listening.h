/** Gives a rig's datagrams to a RigListener. */
#pragma once
#include "diagnosis/internal/RigEvidence.h"

#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
/** From the ports of live lidars, for this long. `goOn` is asked ten times a second; false stops. Throws what
 * UdpReceiver throws. */
void listenLive(const Rig&, Duration, RigListener&, const std::function<bool()>& goOn);

/** The first part of the rig's captures; `goOn` receives the share of the files that was read, false stops. Returns the
 * damages at which files ended. Throws what MergedCaptures throws. */
std::vector<std::string> listenToCaptures(const Rig&, Duration longest, RigListener&,
                                          const std::function<bool(double)>& goOn);
}  // namespace scanloom
