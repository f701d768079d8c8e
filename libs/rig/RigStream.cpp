#include "rig/RigStream.h"

#include "rig/makeBatcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kTick = 1ms;

// Silence changes nothing more in the batcher after this time beyond twice the deadline: one tick does for many.
constexpr Duration kLongestEffect = 10s;
}  // namespace

RigStream::RigStream(const Rig& rig, ReceiveTimes times)
  : router_(routesOf(rig)),
    batcher_(makeBatcher(rig.lidars, rig.batcher)),
    imu_patience_(fromSeconds(1e-3 * rig.batcher.deadline_ms)),
    strange_(rig.lidars.size(), 0)
{
  imu_.addBody(rig.body_imu);
  if (times == ReceiveTimes::OfCapture) capture_clock_.emplace(rig.lidars.size());
  if (rig.batcher.slices > 1) batcher_->onSlice([this](const ScanSlice& slice) { parts_.push_back({copyOf(slice)}); });
}

void RigStream::take(const DatagramView& datagram)
{
  std::optional<RoutedPacket> packet = router_.route(datagram);
  if (!packet) return;
  if (capture_clock_) packet->received = capture_clock_->steady(*packet);
  advance(packet->received);
  if (packet->kind == PacketKind::Imu)
    takeImu(*packet);
  else
    release(batcher_->push(*std::move(packet)));
}

void RigStream::takeImu(const RoutedPacket& packet)
{
  for (ImuSample sample : lidar(packet.lidar).decoder->imuSamples(packet.bytes))
  {
    sample.stamp += batcher_->timeOffset(packet.lidar);
    imu_.add({static_cast<int>(packet.lidar), sample});
  }
}

void RigStream::advance(Timestamp now)
{
  const Timestamp last{std::chrono::floor<std::chrono::milliseconds>(now.time_since_epoch())};
  if (last <= time_) return;
  if (time_ == Timestamp::min() || last - time_ > 2 * imu_patience_ + kLongestEffect) time_ = last - kTick;
  while (time_ < last)
  {
    time_ += kTick;
    release(batcher_->advance(time_));
  }
}

void RigStream::finish()
{
  release(batcher_->finish());
  releaseImu(Timestamp::max());
}

void RigStream::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder, const LidarAddress& address)
{
  router_.replace(lidar, address, decoder.get());  // the batcher keeps it
  batcher_->replace(lidar, std::move(decoder));
}

std::vector<LidarIndex> RigStream::takeDoubted()
{
  std::vector<LidarIndex> doubted = std::exchange(restarted_, {});
  for (LidarIndex i = 0; i < strange_.size(); ++i)
  {
    const LidarCounters& counters = batcher_->counters(i);
    const std::uint64_t strange = counters.malformed_packets + counters.doubtful_packets;
    if (std::exchange(strange_[i], strange) != strange) doubted.push_back(i);
  }
  return doubted;
}

std::optional<SensorEvent> RigStream::next()
{
  if (ready_.empty()) return std::nullopt;
  std::optional<SensorEvent> event(std::move(ready_.front()));
  ready_.pop_front();
  return event;
}

void RigStream::release(std::vector<Scan> scans)
{
  for (Scan& scan : scans)
  {
    releaseImu(scan.end() - imu_patience_);
    releaseParts(scan.end());
    ready_.emplace_back(std::move(scan));
  }
  releaseParts(Timestamp::max());
  if (const auto horizon = batcher_->horizon()) releaseImu(*horizon - imu_patience_);
}

/** Those that end by `end`: where one packet completes several scans, the batcher gives the slices of all of them
 * first.
 */
void RigStream::releaseParts(Timestamp end)
{
  for (; !parts_.empty() && parts_.front().scan.end() <= end; parts_.pop_front())
    ready_.emplace_back(std::move(parts_.front()));
}

void RigStream::releaseImu(Timestamp horizon)
{
  for (SensorImu& imu : imu_.release(horizon)) ready_.emplace_back(std::move(imu));
}

std::vector<std::string> RigStream::takeWarnings()
{
  std::vector<std::string> warnings;
  for (const Notice& notice : batcher_->takeNotices())
  {
    warnings.push_back(textOf(notice, lidar(notice.lidar).name));
    if (notice.kind == Notice::Kind::Restarted) restarted_.push_back(notice.lidar);
  }
  if (const auto step = capture_clock_ ? capture_clock_->takeStep() : std::nullopt)
    warnings.push_back(
        fmt::format("the clock of the computer that captured was set, by {:+.3f} s in all; times of reception are "
                    "corrected for it",
                    seconds(*step)));
  return warnings;
}

RigAccount RigStream::account() const
{
  RigAccount account;
  for (LidarIndex i = 0; i < strange_.size(); ++i) account.lidars.push_back({lidar(i).name, batcher_->counters(i)});
  account.unmatched = router_.unmatched();
  account.late_imu_samples = imu_.late();
  return account;
}
}  // namespace scanloom
