#include "batching/TimeBatcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace scanloom
{
namespace
{
// A consumer that is late returns many at once.
constexpr std::size_t kMostSpareScans = 4;

// Of scans without a column: whoever waits for longer has two recordings, not one with a gap.
constexpr Duration kLongestSilence = 10min;

auto orderOf(Timestamp stamp, std::size_t sensor_id, std::uint16_t measurement_id)
{
  return std::make_tuple(stamp, sensor_id, measurement_id);
}
}  // namespace

TimeBatcher::TimeBatcher(const std::vector<BatchedLidar>& lidars, const BatcherOptions& options)
  : lidars_(lidars),
    options_(options),
    other_clock_(otherClockFromName(options.other_clock)),
    period_(fromSeconds(1 / options.scan_rate)),
    phase_(fromSeconds(1e-3 * options.scan_phase_ms)),
    max_clock_skew_(fromSeconds(options.max_clock_skew))
{
  if (lidars_.empty() || lidars_.size() > kMostLidars)
    throw std::invalid_argument(fmt::format("{} lidars: 1 to {} can be batched", lidars_.size(), kMostLidars));
  for (const BatchedLidar& lidar : lidars_) inputs_.emplace_back(lidar, options_);
  fronts_.assign(inputs_.size(), Timestamp::max());
}

std::vector<Scan> TimeBatcher::push(LidarIndex lidar, Bytes packet, Timestamp received)
{
  now_ = std::max(now_, received);
  take(lidar, packet, received);
  return release();
}

std::vector<Scan> TimeBatcher::advance(Timestamp now)
{
  now_ = std::max(now_, now);
  return release();
}

std::vector<Scan> TimeBatcher::finish()
{
  finished_ = true;
  for (LidarInput& input : inputs_) input.giveUpAll();
  std::vector<Scan> scans = release();
  if (scan_ && !scan_->columns.empty()) scans.push_back(closeScan());
  scan_.reset();
  return scans;
}

void TimeBatcher::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder)
{
  lidars_[lidar].decoder = decoder;
  inputs_[lidar].replace(std::move(decoder));
  if (scan_) return;
  // Nothing is given out yet: what waits is of a clock that nobody can compare any more.
  inputs_[lidar].counters.before_start += inputs_[lidar].queue.clear();
  refreshFront(lidar);
}

void TimeBatcher::recycle(Scan&& scan)
{
  if (spare_.size() < kMostSpareScans) spare_.push_back(std::move(scan));
}

std::vector<Notice> TimeBatcher::takeNotices() { return std::exchange(notices_, {}); }

void TimeBatcher::take(LidarIndex lidar, Bytes packet, Timestamp received)
{
  LidarInput& input = inputs_[lidar];
  std::vector<Notice::Kind> news;
  const bool has_blocks = input.read(packet, received, news);
  noteNews(lidar, news);
  if (!has_blocks) return;

  if (scan_)
  {
    if (input.clock.state() == LidarClock::State::Unknown) settleClock(lidar, news);
    watchClock(lidar);
  }
  if (input.clock.state() == LidarClock::State::Quarantined) return input.quarantine();
  const std::uint64_t dropped = input.counters.dropped;
  input.enqueue(packet);
  refreshFront(lidar);
  if (dropped == 0 && input.counters.dropped > 0) note(lidar, Notice::Kind::QueueFull);
  if (silent_.test(lidar)) note(lidar, Notice::Kind::Back, input.silence());
  silent_.reset(lidar);
}

void TimeBatcher::note(LidarIndex lidar, Notice::Kind kind, Duration duration)
{
  notices_.push_back({kind, lidar, now_, duration, inputs_[lidar].flags()});
}

void TimeBatcher::noteNews(LidarIndex lidar, const std::vector<Notice::Kind>& news)
{
  LidarInput& input = inputs_[lidar];
  for (const Notice::Kind kind : news)
  {
    const bool stepped = kind == Notice::Kind::ClockStepped;
    note(lidar, kind, stepped ? input.step() : Duration{0});
    if (scan_) continue;
    // Nothing is given out yet: what waits is of a clock that is no more.
    if (stepped) input.queue.shift(input.step());
    if (kind == Notice::Kind::Restarted) input.counters.before_start += input.queue.clear();
    refreshFront(lidar);
  }
}

void TimeBatcher::raiseDeadlines()
{
  // A lidar that has not been heard yet is expected to be as quick as the quickest one.
  Duration quickest = Duration::max();
  for (const LidarInput& input : inputs_)
    if (input.clock.isUsed()) quickest = std::min(quickest, input.clock.leastDelay().value_or(Duration::max()));
  if (quickest == Duration::max()) return;
  for (LidarInput& input : inputs_)
  {
    input.giveUpGaps(now_);
    input.raiseDeadline(now_, input.clock.isUsed() ? input.clock.leastDelay().value_or(quickest) : quickest);
  }
}

Timestamp TimeBatcher::watermark(const LidarInput& input) const
{
  if (finished_ || input.clock.state() == LidarClock::State::Quarantined) return Timestamp::max();
  return std::max(input.sequenceMark().value_or(Timestamp::min()), input.deadlineMark());
}

std::optional<Timestamp> TimeBatcher::horizon() const { return scan_ ? std::optional(horizon_) : std::nullopt; }

std::vector<Scan> TimeBatcher::release()
{
  std::vector<Scan> scans;
  if (!scan_)
  {
    const std::optional<Timestamp> latest = latestFirstStamp();
    if (!latest) return scans;
    startAfter(*latest);
  }
  raiseDeadlines();
  Timestamp horizon = Timestamp::max();
  for (const LidarInput& input : inputs_) horizon = std::min(horizon, watermark(input));
  const bool nobody_tells_the_time = horizon == Timestamp::max() && !finished_;  // all are quarantined
  if (!nobody_tells_the_time) horizon_ = std::max(horizon_, horizon);

  // The first of equal stamps is that of the smaller index: the order of columns.
  for (auto oldest = std::min_element(fronts_.begin(), fronts_.end()); *oldest < horizon_;
       oldest = std::min_element(fronts_.begin(), fronts_.end()))
  {
    pass(*oldest, scans);
    append(static_cast<LidarIndex>(oldest - fronts_.begin()));
  }
  if (!finished_) pass(horizon_, scans);
  return scans;
}

void TimeBatcher::refreshFront(LidarIndex lidar)
{
  const PacketQueue& queue = inputs_[lidar].queue;
  fronts_[lidar] = queue.empty() ? Timestamp::max() : queue.front().stamp;
}

/** Nothing older than `time` comes any more. */
void TimeBatcher::pass(Timestamp time, std::vector<Scan>& closed)
{
  while (time >= scan_->end())
  {
    closed.push_back(closeScan());
    skipSilence(time);
  }
  while (time >= sliceEnd()) giveSlice();
}

/** Goes on with the scan of `time` where a new one begins so far before it that nobody wants all those between. */
void TimeBatcher::skipSilence(Timestamp time)
{
  if (time < scan_->start + kLongestSilence) return;
  const std::int64_t scans = (time - scan_->start) / period_;
  scan_->start += scans * period_;
  for (LidarInput& input : inputs_) input.counters.missed_scans += static_cast<std::uint64_t>(scans);
}

void TimeBatcher::append(LidarIndex index)
{
  LidarInput& input = inputs_[index];
  const MeasurementBlock& block = input.queue.front();
  const bool in_order = !last_ || orderOf(block.stamp, index, block.measurement_id) >
                                      orderOf(last_->stamp, last_->sensor_id, last_->measurement_id);
  if (block.stamp < first_start_)
    ++input.counters.before_start;
  else if (block.stamp < sliceBegin() || !in_order)
    ++input.counters.late;
  else
  {
    Column column;
    column.stamp = block.stamp;
    column.first_point = static_cast<std::uint32_t>(scan_->points.size());
    column.measurement_id = block.measurement_id;
    column.frame_id = block.frame_id;
    column.sensor_id = static_cast<std::uint8_t>(index);
    const auto t = static_cast<std::int32_t>((block.stamp - scan_->start).count());
    input.queue.frontDecoder().appendPoints(input.queue.frontPacket(), block.index, t, column.sensor_id, scan_->points);
    column.count = static_cast<std::uint16_t>(scan_->points.size() - column.first_point);
    scan_->columns.push_back(column);
    ++scan_->columns_of[index];
    ++input.counters.emitted;
    input.counters.points += column.count;
    last_ = column;
  }
  input.queue.pop();
  refreshFront(index);
}

Timestamp TimeBatcher::sliceBegin() const { return scan_->start + scan_->period * slices_given_ / options_.slices; }

Timestamp TimeBatcher::sliceEnd() const { return scan_->start + scan_->period * (slices_given_ + 1) / options_.slices; }

void TimeBatcher::giveSlice()
{
  const std::size_t end = scan_->columns.size();
  if (on_slice_) on_slice_({*scan_, slices_given_, options_.slices, columns_given_, end});
  ++slices_given_;
  columns_given_ = end;
}

Scan TimeBatcher::closeScan()
{
  markMissing(*scan_);
  while (slices_given_ < options_.slices) giveSlice();
  slices_given_ = 0;
  columns_given_ = 0;
  Scan closed = std::move(*scan_);
  scan_ = emptyScan(closed.end());
  if (scan_->points.capacity() == 0) scan_->points.reserve(closed.points.size() + closed.points.size() / 16);
  return closed;
}

void TimeBatcher::markMissing(Scan& scan)
{
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    if (inputs_[i].sequenceMark().value_or(Timestamp::min()) >= scan.end() &&
        inputs_[i].clock.state() != LidarClock::State::Quarantined)
      continue;
    scan.missing.set(i);
    if (finished_) continue;
    ++inputs_[i].counters.missed_scans;
    if (scan.columns_of[i] == 0 && !silent_.test(i)) note(i, Notice::Kind::Silent);
    if (scan.columns_of[i] == 0) silent_.set(i);
  }
}

Scan TimeBatcher::emptyScan(Timestamp start)
{
  Scan scan;
  if (!spare_.empty())
  {
    scan = std::move(spare_.back());
    spare_.pop_back();
    scan.columns.clear();
    scan.points.clear();
    scan.missing.reset();
  }
  scan.start = start;
  scan.period = period_;
  scan.columns_of.assign(inputs_.size(), 0);
  return scan;
}
}  // namespace scanloom
