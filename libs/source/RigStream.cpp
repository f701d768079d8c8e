#include "source/RigStream.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kTick = 1ms;

std::vector<RoutedLidar> routesOf(const Rig& rig)
{
  std::vector<RoutedLidar> routes;
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
    routes.push_back({rig.lidars[i].name, rig.addresses[i], rig.lidars[i].decoder.get()});
  return routes;
}
}  // namespace

RigStream::RigStream(const Rig& rig, ReceiveTimes times)
  : lidars_(rig.lidars),
    body_imu_(rig.body_imu.begin(), rig.body_imu.end()),
    router_(routesOf(rig)),
    batcher_(makeBatcher(rig.lidars, rig.batcher)),
    imu_patience_(fromSeconds(1e-3 * rig.batcher.deadline_ms)),
    longest_effect_(2 * imu_patience_ + 10s),
    strange_(rig.lidars.size(), 0)
{
  if (times == ReceiveTimes::OfCapture) capture_clock_.emplace(rig.lidars.size());
  if (rig.batcher.slices > 1) batcher_->onSlice([this](const ScanSlice& slice) { parts_.push_back({copyOf(slice)}); });
}

void RigStream::take(const DatagramView& datagram)
{
  const std::optional<Routed> routed = router_.route(datagram);
  if (!routed) return;

  const Timestamp received = steadyTimeOf(datagram, *routed);
  advance(received);
  if (routed->kind == PacketKind::Imu)
  {
    const BatchedLidar& lidar = lidars_[routed->lidar];
    for (ImuSample sample : lidar.decoder->imuSamples(datagram.payload))
    {
      sample.stamp += batcher_->timeOffset(routed->lidar);
      imu_order_.add({static_cast<int>(routed->lidar), sample});
    }
  }
  else
    release(batcher_->push(routed->lidar, datagram.payload, received));
}

Timestamp RigStream::steadyTimeOf(const DatagramView& datagram, const Routed& routed)
{
  if (!capture_clock_) return datagram.received;
  if (routed.kind == PacketKind::Lidar)
  {
    lidars_[routed.lidar].decoder->readBlocks(datagram.payload, blocks_);
    const auto valid =
        std::find_if(blocks_.begin(), blocks_.end(), [](const MeasurementBlock& block) { return block.valid; });
    if (valid != blocks_.end()) capture_clock_->observe(routed.lidar, valid->stamp, datagram.received);
  }
  return capture_clock_->steady(datagram.received);
}

void RigStream::advance(Timestamp now)
{
  const Timestamp last{std::chrono::floor<std::chrono::milliseconds>(now.time_since_epoch())};
  if (last <= time_) return;
  if (time_ == Timestamp::min() || last - time_ > longest_effect_) time_ = last - kTick;
  while (time_ < last)
  {
    time_ += kTick;
    release(batcher_->advance(time_));
  }
}

void RigStream::takeBodyImu(const std::vector<ImuSample>& samples)
{
  body_imu_.insert(body_imu_.end(), samples.begin(), samples.end());
}

void RigStream::finish()
{
  release(batcher_->finish());
  releaseImu(Timestamp::max());
}

void RigStream::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder, const LidarAddress& address)
{
  router_.replace(lidar, address, decoder.get());
  batcher_->replace(lidar, decoder);
  lidars_[lidar].decoder = std::move(decoder);
}

std::vector<LidarIndex> RigStream::takeDoubted()
{
  std::vector<LidarIndex> doubted = std::exchange(restarted_, {});
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
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

/** Those that are over by `end`: where one packet completes several scans, the batcher gives the slices of all first.
 */
void RigStream::releaseParts(Timestamp end)
{
  for (; !parts_.empty() && parts_.front().scan.end() <= end; parts_.pop_front())
    ready_.emplace_back(std::move(parts_.front()));
}

void RigStream::releaseImu(Timestamp horizon)
{
  for (; !body_imu_.empty() && body_imu_.front().stamp < horizon; body_imu_.pop_front())
    imu_order_.add({SensorImu::kBody, body_imu_.front()});
  for (SensorImu& imu : imu_order_.release(horizon)) ready_.emplace_back(std::move(imu));
}

std::vector<std::string> RigStream::takeWarnings()
{
  std::vector<std::string> warnings;
  for (const Notice& notice : batcher_->takeNotices())
  {
    warnings.push_back(textOf(notice, lidars_[notice.lidar].name));
    if (notice.kind == Notice::Kind::Restarted) restarted_.push_back(notice.lidar);
  }
  if (capture_clock_ && std::exchange(capture_clock_steps_, capture_clock_->steps()) != capture_clock_->steps())
    warnings.push_back(fmt::format(
        "the clock of the computer that captured was set, by {:+.3f} s in all; times of reception go on without it",
        seconds(capture_clock_->step())));
  return warnings;
}

RigAccount RigStream::account() const
{
  RigAccount account;
  for (LidarIndex i = 0; i < lidars_.size(); ++i) account.lidars.push_back({lidars_[i].name, batcher_->counters(i)});
  account.unmatched = router_.unmatched();
  account.late_imu_samples = imu_order_.late();
  return account;
}
}  // namespace scanloom
