#include "input/rig/internal/ReceivePace.h"

#include "base/core/Statistics.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
constexpr std::size_t kEnough = 50;           // pairs of packets
constexpr Duration kLongestGap = 500ms;       // of stamps: over a longer one a lidar may have restarted
constexpr double kThousand = 3, kNear = 0.3;  // decades: a factor of two is no power of 1000

struct Times
{
  Timestamp stamp, received;
};

std::optional<Timestamp> stampOf(const RoutedPacket& packet)
{
  const auto valid = std::find_if(packet.blocks.begin(), packet.blocks.end(), [](const auto& b) { return b.valid; });
  return valid == packet.blocks.end() ? std::nullopt : std::optional(valid->stamp);
}

std::vector<double> pacesOf(const std::vector<RoutedLidar>& lidars, const std::vector<Datagram>& datagrams)
{
  PacketRouter router(lidars);
  std::vector<std::optional<Times>> last(lidars.size());
  std::vector<double> paces;
  for (const Datagram& datagram : datagrams)
  {
    const std::optional<RoutedPacket> packet = router.route(datagram);
    const auto stamp = packet ? stampOf(*packet) : std::nullopt;
    if (!stamp) continue;
    if (auto& before = last[packet->lidar]; before && *stamp > before->stamp && *stamp - before->stamp < kLongestGap)
      paces.push_back(seconds(datagram.received - before->received) / seconds(*stamp - before->stamp));
    last[packet->lidar] = Times{*stamp, datagram.received};
  }
  return paces;
}
}  // namespace

double receivePace(const std::vector<RoutedLidar>& lidars, const std::vector<Datagram>& datagrams)
{
  const std::vector<double> paces = pacesOf(lidars, datagrams);
  if (paces.size() < kEnough) return 1;
  const double decades = std::log10(median(paces));
  const double whole = kThousand * std::round(decades / kThousand);
  return std::isfinite(decades) && std::abs(decades - whole) < kNear ? std::pow(10, whole) : 1;
}
}  // namespace scanloom
