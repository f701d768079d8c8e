#include "batching/TimeBatcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace scanloom
{
namespace
{
// Further from its arrival than this a stamp is no stamp of the clock that its lidar had before.
constexpr Duration kClockJump = 1s;

// Year 2200: differences of plausible stamps cannot overflow.
constexpr Timestamp kLatest{Duration{std::chrono::hours{24 * 365 * 230}}};

Duration floorMod(Duration a, Duration b) { return (a % b + b) % b; }

auto orderOf(Timestamp stamp, std::size_t sensor_id, std::uint16_t measurement_id)
{
  return std::make_tuple(stamp, sensor_id, measurement_id);
}
}  // namespace

TimeBatcher::TimeBatcher(std::vector<BatchedLidar> lidars, const BatcherOptions& options)
  : inputs_(std::move(lidars)),
    options_(options),
    period_(fromSeconds(1 / options.scan_rate)),
    phase_(fromSeconds(1e-3 * options.scan_phase_ms)),
    deadline_(fromSeconds(1e-3 * options.deadline_ms))
{
  if (inputs_.empty() || inputs_.size() > 256)
    throw std::invalid_argument(fmt::format("{} lidars: 1 to 256 can be batched", inputs_.size()));
  for (const BatchedLidar& input : inputs_)
    lidars_.push_back({PacketQueue(static_cast<std::size_t>(options.queue_packets)),
                       Sequencer(input.decoder->description(), deadline_),
                       {},
                       {},
                       {},
                       {}});
}

std::vector<Scan> TimeBatcher::push(LidarIndex lidar, Bytes packet, Timestamp received)
{
  now_ = std::max(now_, received);
  if (!take(lidar, packet, received)) return {};
  return release();
}

std::vector<Scan> TimeBatcher::advance(Timestamp now)
{
  now_ = std::max(now_, now);
  return release();
}

bool TimeBatcher::take(LidarIndex index, Bytes packet, Timestamp received)
{
  Lidar& lidar = lidars_[index];
  LidarCounters& count = lidar.counters;
  const PacketDecoder& decoder = *inputs_[index].decoder;
  switch (decoder.kind(packet))
  {
    case PacketKind::Lidar:
      break;
    case PacketKind::Malformed:
      ++count.malformed_packets;
      return false;
    case PacketKind::BadCrc:
      ++count.bad_crc_packets;
      return false;
    case PacketKind::Foreign:
      ++count.foreign_packets;
      return false;
    case PacketKind::Imu:
    case PacketKind::Other:
      ++count.other_packets;
      return false;
  }

  decoder.readBlocks(packet, blocks_);
  if (blocks_.empty()) return false;
  ++count.packets;
  count.received += blocks_.size();
  const auto all = static_cast<std::uint64_t>(blocks_.size());
  const std::vector<MeasurementBlock> usable = usableBlocks(index, received);
  // The ids of blocks that the sensor itself calls invalid may be anything, their stamps too.
  MeasurementBlock last = usable.empty() ? blocks_.front() : usable.back();
  if (usable.empty()) last.stamp = Timestamp::min();
  if (last.measurement_id >= decoder.description().columns_per_frame) return true;

  switch (lidar.sequencer.accept(decoder.header(packet), last, received))
  {
    case Sequencer::Verdict::New:
      break;
    case Sequencer::Verdict::Recovered:
      count.lost -= all;
      break;
    case Sequencer::Verdict::Restarted:
      ++count.restarts;
      break;
    case Sequencer::Verdict::Duplicate:
      count.duplicate += usable.size();
      return true;
  }
  if (usable.empty()) return true;

  if (!scan_) lidar.first_stamp = std::min(lidar.first_stamp.value_or(Timestamp::max()), usable.front().stamp);
  lidar.least_delay = std::min(lidar.least_delay.value_or(Duration::max()), received - usable.back().stamp);
  count.dropped += lidar.queue.push(packet, usable);
  return true;
}

/** The blocks in hand that are valid and in time order, on the common clock; the others are counted. */
std::vector<MeasurementBlock> TimeBatcher::usableBlocks(LidarIndex index, Timestamp received)
{
  Lidar& lidar = lidars_[index];
  const int columns = inputs_[index].decoder->description().columns_per_frame;
  const auto plausible = [&](const MeasurementBlock& block)
  {
    if (block.measurement_id >= columns || block.stamp < Timestamp{} || block.stamp > kLatest) return false;
    if (!lidar.least_delay) return true;
    const Duration lateness = received - (block.stamp + inputs_[index].time_offset) - *lidar.least_delay;
    return lateness > -kClockJump && lateness < period_ + kClockJump;
  };

  std::vector<MeasurementBlock> usable;
  usable.reserve(blocks_.size());
  for (MeasurementBlock block : blocks_)
  {
    if (!block.valid)
      ++lidar.counters.invalid;
    else if (!plausible(block) || (!usable.empty() && block.stamp + inputs_[index].time_offset < usable.back().stamp))
      ++lidar.counters.implausible;
    else
    {
      block.stamp += inputs_[index].time_offset;
      usable.push_back(block);
    }
  }
  return usable;
}

void TimeBatcher::raiseDeadlines()
{
  // A lidar that has not been heard yet is expected to be as quick as the quickest one.
  Duration quickest = Duration::max();
  for (const Lidar& lidar : lidars_) quickest = std::min(quickest, lidar.least_delay.value_or(Duration::max()));
  if (quickest == Duration::max()) return;

  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    Lidar& lidar = lidars_[i];
    const LidarDescription& description = inputs_[i].decoder->description();
    const std::uint64_t lost_packets = finished_ ? lidar.sequencer.finish() : lidar.sequencer.giveUpGaps(now_);
    lidar.counters.lost += lost_packets * static_cast<std::uint64_t>(description.columns_per_packet);
    lidar.sequence_mark = lidar.sequencer.watermark();
    // The oldest block of a packet under way is one packet's duration older than its newest.
    const Duration packet = description.blockPeriod() * description.columns_per_packet;
    lidar.deadline_mark = now_ - lidar.least_delay.value_or(quickest) - packet - deadline_;
  }
}

Timestamp TimeBatcher::watermark(const Lidar& lidar) const
{
  if (finished_) return Timestamp::max();
  return std::max(lidar.sequence_mark.value_or(Timestamp::min()), lidar.deadline_mark);
}

std::optional<Timestamp> TimeBatcher::horizon() const
{
  if (!scan_) return std::nullopt;
  Timestamp horizon = Timestamp::max();
  for (const Lidar& lidar : lidars_) horizon = std::min(horizon, watermark(lidar));
  return horizon;
}

/**
 * t_0,max of eq. (1), once it is certain. A lidar that is silent is waited for one period, which costs nothing (no full
 * scan could be over sooner); one that starts after that joins later, the grid being absolute.
 */
std::optional<Timestamp> TimeBatcher::latestFirstStamp() const
{
  Timestamp earliest = Timestamp::max();
  for (const Lidar& lidar : lidars_) earliest = std::min(earliest, lidar.first_stamp.value_or(Timestamp::max()));
  if (earliest == Timestamp::max()) return std::nullopt;

  Timestamp latest = earliest;
  for (const Lidar& lidar : lidars_)
  {
    const Timestamp first = std::min(lidar.first_stamp.value_or(Timestamp::max()), earliest + period_);
    if (!finished_ && lidar.deadline_mark < first) return std::nullopt;
    if (lidar.first_stamp == first) latest = std::max(latest, first);
  }
  return latest;
}

void TimeBatcher::startAfter(Timestamp latest)
{
  refuseDifferentClocks();
  first_start_ = latest - floorMod(latest.time_since_epoch() - phase_, period_) + period_;  // eq. (1)
  scan_ = emptyScan(first_start_);
}

void TimeBatcher::refuseDifferentClocks() const
{
  const Lidar* reference = nullptr;
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    if (!lidars_[i].least_delay) continue;
    if (!reference) reference = &lidars_[i];
    const double skew = seconds(*reference->least_delay) - seconds(*lidars_[i].least_delay);
    if (std::abs(skew) > options_.max_clock_skew)
      throw std::runtime_error(fmt::format(
          "lidar '{}' is {:+.6f} s off the clock of lidar '{}': synchronise them (PTP) or give its time_offset",
          inputs_[i].name, skew, inputs_[static_cast<std::size_t>(reference - lidars_.data())].name));
  }
}

std::vector<Scan> TimeBatcher::release()
{
  std::vector<Scan> scans;
  raiseDeadlines();
  if (!scan_)
  {
    const std::optional<Timestamp> latest = latestFirstStamp();
    if (!latest) return scans;
    startAfter(*latest);
  }
  const Timestamp horizon = *this->horizon();
  for (auto next = oldest(); next && lidars_[*next].queue.front().stamp < horizon; next = oldest())
  {
    while (lidars_[*next].queue.front().stamp >= scan_->end()) scans.push_back(closeScan());
    appendOldest(*next);
  }
  if (!finished_)
    while (horizon >= scan_->end()) scans.push_back(closeScan());
  return scans;
}

std::vector<Scan> TimeBatcher::finish()
{
  finished_ = true;
  std::vector<Scan> scans = release();
  if (scan_ && !scan_->columns.empty()) scans.push_back(closeScan());
  scan_.reset();
  return scans;
}

std::optional<LidarIndex> TimeBatcher::oldest() const
{
  std::optional<LidarIndex> oldest;
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
    if (!lidars_[i].queue.empty() && (!oldest || lidars_[i].queue.front().stamp < lidars_[*oldest].queue.front().stamp))
      oldest = i;
  return oldest;
}

void TimeBatcher::appendOldest(LidarIndex index)
{
  Lidar& lidar = lidars_[index];
  const MeasurementBlock& block = lidar.queue.front();
  const bool in_order = !last_ || orderOf(block.stamp, index, block.measurement_id) >=
                                      orderOf(last_->stamp, last_->sensor_id, last_->measurement_id);
  if (block.stamp < first_start_)
    ++lidar.counters.before_start;
  else if (block.stamp < scan_->start || !in_order)
    ++lidar.counters.late;
  else
  {
    Column column;
    column.stamp = block.stamp;
    column.first_point = static_cast<std::uint32_t>(scan_->points.size());
    column.measurement_id = block.measurement_id;
    column.frame_id = block.frame_id;
    column.sensor_id = static_cast<std::uint8_t>(index);
    const auto t = static_cast<std::int32_t>((block.stamp - scan_->start).count());
    inputs_[index].decoder->appendPoints(lidar.queue.frontPacket(), block.index, t, column.sensor_id, scan_->points);
    column.count = static_cast<std::uint16_t>(scan_->points.size() - column.first_point);
    scan_->columns.push_back(column);
    ++scan_->columns_of[index];
    ++lidar.counters.emitted;
    lidar.counters.points += column.count;
    last_ = column;
  }
  lidar.queue.pop();
}

Scan TimeBatcher::closeScan()
{
  Scan closed = std::move(*scan_);
  for (const Lidar& lidar : lidars_)
    if (lidar.sequence_mark.value_or(Timestamp::min()) < closed.end()) closed.complete = false;
  scan_ = emptyScan(closed.end());
  scan_->points.reserve(closed.points.size() + closed.points.size() / 16);
  return closed;
}

Scan TimeBatcher::emptyScan(Timestamp start) const
{
  Scan scan;
  scan.start = start;
  scan.period = period_;
  scan.columns_of.assign(lidars_.size(), 0);
  return scan;
}
}  // namespace scanloom
