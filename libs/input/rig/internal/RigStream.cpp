#include "input/rig/internal/RigStream.h"

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
    batcher_(rig.lidars, rig.batcher),
    imu_patience_(fromSeconds(1e-3 * rig.batcher.deadline_ms)),
    lidar_imus_(rig.lidars.size()),
    strange_(rig.lidars.size(), 0)
{
  imu_.addBody(rig.body_imu);
  if (times == ReceiveTimes::OfCapture) capture_clock_.emplace(rig.lidars.size());
  if (rig.batcher.slices > 1) batcher_.onSlice([this](const ScanSlice& slice) { parts_.push_back({copyOf(slice)}); });
}

void RigStream::take(const DatagramView& datagram)
{
  std::optional<RoutedPacket> packet = router_.route(datagram);
  if (!packet) return;
  if (capture_clock_) packet->received = capture_clock_->steady(*packet);
  advance(packet->received);
  if (packet->kind == PacketKind::Imu)
  {
    takeImu(*packet);
    return;
  }
  const LidarIndex lidar = packet->lidar;
  const Timestamp received = packet->received;
  if (packet->of_new_sender) lidar_imus_[lidar].by_lidar = false;
  std::vector<Scan> scans = onward([&] { return batcher_.push(*std::move(packet)); });
  judgeEarlyImu(lidar, received);
  release(std::move(scans));
}

void RigStream::takeImu(const RoutedPacket& packet)
{
  LidarImu& imu = lidar_imus_[packet.lidar];
  for (ImuSample sample : lidar(packet.lidar).decoder->imuSamples(packet.bytes))
  {
    const std::optional<Duration> ahead = batcher_.ahead(packet.lidar, sample.stamp, packet.received);
    if (!imu.continuity.accepts(sample.stamp, packet.received, ahead))
    {
      ++imu.implausible;
      continue;
    }
    sample.stamp += batcher_.timeOffset(packet.lidar);
    imu_.add({static_cast<int>(packet.lidar), sample});
  }
}

/** Before the first scan clocks are compared: the IMU samples that wait are moved with the stamps of their lidars. */
std::vector<Scan> RigStream::onward(const std::function<std::vector<Scan>()>& step)
{
  if (batcher_.horizon()) return step();
  std::vector<Duration> offsets;
  for (LidarIndex i = 0; i < lidar_imus_.size(); ++i) offsets.push_back(batcher_.timeOffset(i));
  std::vector<Scan> scans = step();
  for (LidarIndex i = 0; i < offsets.size(); ++i)
    if (const Duration later = batcher_.timeOffset(i) - offsets[i]; later != Duration{0})
      imu_.shift(static_cast<int>(i), later);
  return scans;
}

/** What was ahead of the lidar's clock before its first packet would wait until the end. */
void RigStream::judgeEarlyImu(LidarIndex lidar, Timestamp received)
{
  LidarImu& imu = lidar_imus_[lidar];
  const std::optional<Duration> ahead =
      imu.by_lidar ? std::nullopt : batcher_.ahead(lidar, received, received);  // of a clock that shows host time
  if (!ahead) return;
  imu.by_lidar = true;
  const Timestamp shown = received - *ahead + batcher_.timeOffset(lidar);
  imu.implausible += imu_.dropAfter(static_cast<int>(lidar), shown + kArrivalTolerance);
}

void RigStream::advance(Timestamp now)
{
  const Timestamp last{std::chrono::floor<std::chrono::milliseconds>(now.time_since_epoch())};
  if (last <= time_) return;
  if (time_ == Timestamp::min() || last - time_ > 2 * imu_patience_ + kLongestEffect) time_ = last - kTick;
  while (time_ < last)
  {
    time_ += kTick;
    release(onward([&] { return batcher_.advance(time_); }));
  }
}

void RigStream::finish()
{
  release(batcher_.finish());
  releaseImu(Timestamp::max());
}

void RigStream::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder, const LidarAddress& address)
{
  router_.replace(lidar, address, decoder.get());  // the batcher keeps it
  batcher_.replace(lidar, std::move(decoder));
}

std::vector<LidarIndex> RigStream::takeSuspects()
{
  std::vector<LidarIndex> suspects = std::exchange(restarted_, {});
  for (LidarIndex i = 0; i < strange_.size(); ++i)
  {
    const LidarCounters& counters = batcher_.counters(i);
    const std::uint64_t strange = counters.malformed_packets + counters.doubtful_packets;
    if (std::exchange(strange_[i], strange) != strange) suspects.push_back(i);
  }
  return suspects;
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
  if (const auto horizon = batcher_.horizon()) releaseImu(*horizon - imu_patience_);
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
  for (const Notice& notice : batcher_.takeNotices())
  {
    warnings.push_back(textOf(notice, lidar(notice.lidar).name));
    if (notice.kind == Notice::Kind::Restarted) restarted_.push_back(notice.lidar);
  }
  for (std::string& warning : router_.takeWarnings()) warnings.push_back(std::move(warning));
  for (LidarIndex i = 0; i < lidar_imus_.size(); ++i)
    if (lidar_imus_[i].implausible > 0 && !std::exchange(lidar_imus_[i].reported, true))
      warnings.push_back(
          fmt::format("lidar '{}': IMU samples whose stamps its clock can't have shown are left out and counted "
                      "(imu_samples_implausible): they are damaged, or another sender's; then give the lidar its key "
                      "'address'",
                      lidar(i).name));
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
  for (LidarIndex i = 0; i < strange_.size(); ++i)
    account.lidars.push_back({lidar(i).name, batcher_.counters(i), router_.ofOtherSenders(i), batcher_.timeOffset(i)});
  account.unmatched = router_.unmatched();
  account.late_imu_samples = imu_.late();
  for (const LidarImu& imu : lidar_imus_) account.implausible_imu_samples += imu.implausible;
  account.input["imu_samples_dropped"] = imu_.dropped();
  return account;
}
}  // namespace scanloom
