#include "lab/simulation/internal/ScenePackets.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr Duration kSlice = 250ms;
}

ScenePackets::ScenePackets(const Scene& scene) : scene_(scene), simulated_(scene.span.start), settled_(scene.span.start)
{
  for (const LidarStation& station : scene.lidars) streams_.emplace_back(scene, station);
}

bool ScenePackets::next(Datagram& datagram)
{
  // Packets of the next slice are received after the end of this one, so none of them can come first.
  const auto isReady = [&]
  { return next_ < waiting_.size() && (simulated_ == scene_.span.end() || waiting_[next_].received < simulated_); };
  while (!isReady() && simulated_ < scene_.span.end()) simulateSlice();
  if (!isReady())
  {
    settled_ = scene_.span.end();
    return false;
  }
  datagram = std::move(waiting_[next_++]);
  settled_ = datagram.received;
  return true;
}

void ScenePackets::simulateSlice()
{
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  simulated_ = std::min(simulated_ + kSlice, scene_.span.end());
  for (PacketStream& stream : streams_)
    for (Datagram& datagram : stream.finishedBefore(simulated_)) waiting_.push_back(std::move(datagram));
  std::stable_sort(waiting_.begin(), waiting_.end(),
                   [](const Datagram& a, const Datagram& b) { return a.received < b.received; });
}

double ScenePackets::share() const { return std::min(1.0, scene_.span.secondsAt(settled_) / scene_.span.duration); }
}  // namespace scanloom
