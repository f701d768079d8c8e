#include "cycloneConfiguration.h"

#include <fmt/format.h>
#include <unistd.h>

namespace scanloom
{
std::string configurationOf(const Ros2Network& network)
{
  using Range = Ros2Network::Range;
  std::string config =
      "<General><FragmentSize>14000 B</FragmentSize></General>"
      "<Internal><Watermarks><WhcHigh>1 GB</WhcHigh><WhcHighInit>1 GB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks><MaxSampleSize>256 MB</MaxSampleSize>"
      "<MaxQueuedRexmitBytes>64 MB</MaxQueuedRexmitBytes>"
      "<HeartbeatInterval min=\"2 ms\" minsched=\"2 ms\" max=\"1 s\">10 ms</HeartbeatInterval></Internal>";
  if (network.range == Range::Localhost || network.range == Range::Off)
    config += "<General><AllowMulticast>false</AllowMulticast></General>";
  if (network.range == Range::Off)  // only who has the same tag is heard
    config += fmt::format(
        "<Discovery><ParticipantIndex>none</ParticipantIndex><Tag>ros_discovery_off_{}</Tag></Discovery>", ::getpid());
  else if (network.range != Range::Default)
  {
    std::string peers = network.range == Range::Localhost ? "<Peer address=\"localhost\"/>" : "";
    for (const std::string& peer : network.peers) peers += fmt::format("<Peer address=\"{}\"/>", peer);
    config +=
        "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>";
    if (!peers.empty()) config += "<Peers>" + peers + "</Peers>";
    config += "</Discovery>";
  }
  return "<CycloneDDS><Domain>" + config + "</Domain></CycloneDDS>," + network.configuration;
}
}  // namespace scanloom
