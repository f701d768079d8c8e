#include "input/rig/internal/PacedCaptures.h"

#include "base/core/Statistics.h"
#include "input/bags/BagPackets.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kEnough = 50;           // pairs of packets
constexpr Duration kLongestGap = 500ms;       // of stamps: over a longer one a lidar may have restarted
constexpr Duration kLongestPause = 20s;       // of all sensors; captures that are written in turn follow at once
constexpr double kThousand = 3, kNear = 0.3;  // decades: a factor of two is no power of 1000

struct Times
{
  Timestamp stamp, received;
};

std::vector<double> pacesOf(const std::vector<RoutedLidar>& lidars, const std::deque<Datagram>& datagrams)
{
  PacketRouter router(lidars);
  std::vector<std::optional<Times>> last(lidars.size());
  std::vector<double> paces;
  for (const Datagram& datagram : datagrams)
  {
    const std::optional<RoutedPacket> packet = router.route(datagram);
    const auto stamp = packet ? packet->firstStamp() : std::nullopt;
    if (!stamp) continue;
    if (auto& before = last[packet->lidar]; before && *stamp > before->stamp && *stamp - before->stamp < kLongestGap)
      paces.push_back(seconds(datagram.received - before->received) / seconds(*stamp - before->stamp));
    last[packet->lidar] = Times{*stamp, datagram.received};
  }
  return paces;
}
}  // namespace

double receivePace(const std::vector<RoutedLidar>& lidars, const std::deque<Datagram>& datagrams)
{
  const std::vector<double> paces = pacesOf(lidars, datagrams);
  if (paces.size() < kEnough) return 1;
  const double decades = std::log10(median(paces));
  const double whole = kThousand * std::round(decades / kThousand);
  return std::isfinite(decades) && std::abs(decades - whole) < kNear ? std::pow(10, whole) : 1;
}

PacedCaptures::PacedCaptures(const Rig& rig)
  : captures_(datagramsOf(rig.captures)), of_several_(rig.captures.size() > 1), notes_(rig.notes)
{
  constexpr std::size_t kLookedAt = 500, kBytes = 16'000'000;  // datagrams; those of a bag's clouds are large
  std::size_t bytes = 0;
  for (Datagram datagram; first_.size() < kLookedAt && bytes < kBytes && captures_.next(datagram);)
  {
    bytes += datagram.payload.size();
    first_.push_back(datagram);
  }
  if (first_.empty()) return;
  begin_ = first_.front().received;
  pace_ = receivePace(routesOf(rig), first_);
  if (pace_ != 1)
    notes_.push_back(
        fmt::format("times of reception run {:g} times as fast as the sensors' clocks: they are taken to be "
                    "in a wrong unit, and divided by it",
                    pace_));
}

bool PacedCaptures::next(Datagram& datagram)
{
  if (!first_.empty())
  {
    datagram = std::move(first_.front());
    first_.pop_front();
  }
  else if (!captures_.next(datagram))
    return false;
  if (pace_ != 1) datagram.received = begin_ + fromSeconds(seconds(datagram.received - begin_) / pace_);
  noteLongPause(datagram.received);
  return true;
}

void PacedCaptures::noteLongPause(Timestamp received)
{
  const Timestamp last = std::exchange(last_, received);
  if (of_several_ && last != Timestamp{} && received - last > kLongestPause)
    notes_.push_back(
        fmt::format("no packet for {:.0f} s between two captures: if they are of two drives, each needs a run of its "
                    "own, with its capture named",
                    seconds(received - last)));
}

std::vector<std::string> PacedCaptures::takeWarnings()
{
  std::vector<std::string> warnings = std::exchange(notes_, {});
  const CaptureCounters captures = captures_.counters();
  if (captures.truncated && !std::exchange(cut_is_reported_, true))
    warnings.push_back("a capture ends inside a record: everything before it was read");
  for (; damages_reported_ < captures.damages.size(); ++damages_reported_)
    warnings.push_back(captures.damages[damages_reported_]);
  return warnings;
}
}  // namespace scanloom
