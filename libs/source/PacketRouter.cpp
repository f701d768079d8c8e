#include "source/PacketRouter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::size_t kStrangers = 1000;

/** The better a decoder understands a packet, the smaller. */
int strangeness(PacketKind kind)
{
  switch (kind)
  {
    case PacketKind::Lidar:
    case PacketKind::Imu:
    case PacketKind::Other:
      return 0;
    case PacketKind::BadCrc:
      return 1;
    case PacketKind::Malformed:
      return 2;
    case PacketKind::Foreign:
      return 3;
  }
  return 3;
}

bool listensTo(const LidarAddress& address, const DatagramView& datagram)
{
  if (address.source && *address.source != datagram.source) return false;
  const std::uint16_t port = datagram.destination_port;
  return port != 0 && (port == address.lidar_port || port == address.imu_port);
}

void refuseWithoutPort(const std::string& label, const LidarAddress& address)
{
  if (address.lidar_port == 0)
    throw std::invalid_argument(
        fmt::format("lidar '{}' has no UDP port: give its key 'port', or metadata that names one", label));
}

/** Those that understand the packet best; none if it is foreign to all. */
std::vector<Routed> bestOf(std::vector<Routed> candidates)
{
  int best = strangeness(PacketKind::Foreign);
  for (const Routed& candidate : candidates) best = std::min(best, strangeness(candidate.kind));
  const auto worse = [best](const Routed& candidate)
  { return strangeness(candidate.kind) > best || candidate.kind == PacketKind::Foreign; };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), worse), candidates.end());
  return candidates;
}
}  // namespace

PacketRouter::PacketRouter(std::vector<RoutedLidar> lidars) : lidars_(std::move(lidars))
{
  for (const RoutedLidar& lidar : lidars_) refuseWithoutPort(lidar.label, lidar.address);
}

void PacketRouter::replace(std::size_t lidar, const LidarAddress& address, const PacketDecoder* decoder)
{
  refuseWithoutPort(lidars_[lidar].label, address);
  lidars_[lidar].address = address;
  lidars_[lidar].decoder = decoder;
}

std::optional<Routed> PacketRouter::route(const DatagramView& datagram)
{
  const std::optional<Routed> routed = decide(datagram);
  if (!routed) ++unmatched_[strangerOf(datagram)];
  return routed;
}

/** A network can hold more senders than memory should be spent on. */
Origin PacketRouter::strangerOf(const DatagramView& datagram) const
{
  const Origin origin{datagram.destination_port, datagram.source};
  return unmatched_.size() < kStrangers || unmatched_.count(origin) > 0 ? origin : Origin{};
}

std::optional<Routed> PacketRouter::decide(const DatagramView& datagram)
{
  std::vector<Routed> best = bestOf(candidates(datagram));
  if (best.size() == 1)
  {
    if (best.front().kind == PacketKind::Lidar) lidars_at_[datagram.source].insert(best.front().lidar);
    return best.front();
  }
  if (best.empty()) return std::nullopt;

  best = fromKnownSource(best, datagram.source);
  if (best.size() == 1) return best.front();
  if (std::any_of(best.begin(), best.end(), [](const Routed& r) { return r.kind == PacketKind::Lidar; }))
    throw ambiguous(datagram, best);
  return std::nullopt;
}

std::vector<Routed> PacketRouter::candidates(const DatagramView& datagram) const
{
  // Who names this very source does not share it with those who take any.
  const bool named =
      std::any_of(lidars_.begin(), lidars_.end(),
                  [&](const RoutedLidar& lidar) { return lidar.address.source && listensTo(lidar.address, datagram); });
  std::vector<Routed> candidates;
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    const LidarAddress& address = lidars_[i].address;
    if (lidars_[i].decoder && listensTo(address, datagram) && address.source.has_value() == named)
      candidates.push_back({i, lidars_[i].decoder->kind(datagram.payload)});
  }
  return candidates;
}

/** All of them if the source says nothing. */
std::vector<Routed> PacketRouter::fromKnownSource(const std::vector<Routed>& candidates, const IpAddress& source) const
{
  const auto known = lidars_at_.find(source);
  if (known == lidars_at_.end()) return candidates;
  std::vector<Routed> from_there;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(from_there),
               [&](const Routed& r) { return known->second.count(r.lidar) > 0; });
  return from_there.empty() ? candidates : from_there;
}

std::runtime_error PacketRouter::ambiguous(const DatagramView& datagram, const std::vector<Routed>& candidates) const
{
  std::vector<std::string> labels;
  for (const Routed& candidate : candidates) labels.push_back(lidars_[candidate.lidar].label);
  return std::runtime_error(fmt::format(
      "lidar packet from {} at port {} may be of '{}': it holds no serial number; give each of these lidars its "
      "key 'address' (the sensor's own IP address) or a 'port' of its own",
      datagram.source.text(), datagram.destination_port, fmt::join(labels, "' or '")));
}
}  // namespace scanloom
