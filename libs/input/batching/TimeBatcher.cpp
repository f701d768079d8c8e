#include "input/batching/TimeBatcher.h"

#include "input/batching/internal/FirstScan.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
// After so long without a column, empty scans are left out: two recordings follow each other, nobody wants the time
// between.
constexpr Duration kLongestSilence = 10min;
}  // namespace

TimeBatcher::TimeBatcher(const std::vector<BatchedLidar>& lidars, const BatcherOptions& options)
  : lidars_(lidars),
    options_(options),
    period_(fromSeconds(1 / options.scan_rate)),
    fronts_(lidars.size(), Timestamp::max()),
    clocks_(lidars, options),
    notices_(lidars.size())
{
  if (lidars_.empty() || lidars_.size() > kMostLidars)
    throw std::invalid_argument(fmt::format("{} lidars: 1 to {} can be batched", lidars_.size(), kMostLidars));
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    inputs_.push_back(
        {std::nullopt, std::nullopt, PacketQueue(static_cast<std::size_t>(options_.queue_packets)), {}, deadline()});
    if (lidars_[i].decoder) follow(i);
  }
}

std::vector<Scan> TimeBatcher::push(RoutedPacket packet)
{
  now_ = std::max(now_, packet.received);
  enqueue(std::move(packet));
  return merge();
}

std::vector<Scan> TimeBatcher::advance(Timestamp now)
{
  now_ = std::max(now_, now);
  return merge();
}

std::vector<Scan> TimeBatcher::finish()
{
  finished_ = true;
  for (Input& input : inputs_)
    if (input.stream) input.stream->giveUpAllGaps(input.counters);
  std::vector<Scan> scans = merge();
  if (scan_ && !scan_->scan().columns.empty()) scans.push_back(scan_->close(missingLidars(), on_slice_));
  scan_.reset();
  return scans;
}

/** The paper's five steps, for every block that can be taken. */
std::vector<Scan> TimeBatcher::merge()
{
  std::vector<Scan> closed;
  if (!scan_) startScans();  // eq. (1)
  if (!scan_) return closed;

  raiseHorizon();  // first step: which blocks have no older one to come
  const auto oldest = [this] { return std::min_element(fronts_.begin(), fronts_.end()); };
  for (auto front = oldest(); *front < horizon_;
       front = oldest())  // second: the smallest stamp, then the smaller index
  {
    closeUntil(*front, closed);
    takeOldestBlock(static_cast<LidarIndex>(front - fronts_.begin()));  // third to fifth: convert, append, mark as used
  }
  if (!finished_) closeUntil(horizon_, closed);
  return closed;
}

void TimeBatcher::enqueue(RoutedPacket packet)
{
  const LidarIndex lidar = packet.lidar;
  Input& input = inputs_[lidar];
  if (!countUnlessLidar(input.stream ? packet.kind : PacketKind::Other, input.counters)) return;
  if (packet.of_new_sender) beginAnew(lidar);
  const Bytes bytes = packet.bytes;
  const Timestamp received = packet.received;
  std::optional<SequencedPacket> read = input.stream->read(std::move(packet), input.counters);
  if (!read) return;
  noteBreak(lidar, *read);
  if (read->blocks.empty()) return;

  LidarClock& clock = clocks_[lidar];
  if (!scan_ && !input.presence->note(read->blocks.back().stamp, received)) clock.restarted();
  clock.observe(read->blocks.back().stamp, received);
  notices_.noteArrival(lidar, received);
  if (scan_) settleClock(lidar, *read);
  if (clock.state() == LidarClock::State::Quarantined)
  {
    input.counters.quarantined += read->blocks.size();
    return;
  }
  for (MeasurementBlock& block : read->blocks) block.stamp += clock.offset();
  const std::size_t dropped = input.queue.push(bytes, std::move(read->blocks), lidars_[lidar].decoder);
  if (dropped > 0 && input.counters.dropped == 0) notices_.note(lidar, Notice::Kind::QueueFull, now_);
  input.counters.dropped += dropped;
  refreshFront(lidar);
  notices_.noteBack(lidar, now_);
}

void TimeBatcher::noteBreak(LidarIndex lidar, const SequencedPacket& read)
{
  Input& input = inputs_[lidar];
  notices_.noteFlags(lidar, read.flags, now_);
  if (read.restarted || read.clock_step) input.presence->restart();
  if (read.restarted)
  {
    clocks_[lidar].restarted();
    notices_.note(lidar, Notice::Kind::Restarted, now_);
  }
  if (read.clock_step)
  {
    clocks_[lidar].stepped(*read.clock_step);
    notices_.note(lidar, Notice::Kind::ClockStepped, now_, *read.clock_step);
  }
  if (scan_) return;
  // Nothing was given out yet: what waits follows the clock, or is of a clock that is no more.
  if (read.clock_step) input.queue.shift(*read.clock_step);
  if (read.restarted) input.counters.before_start += input.queue.clear();
  refreshFront(lidar);
}

void TimeBatcher::settleClock(LidarIndex lidar, const SequencedPacket& read)
{
  if (const auto change = clocks_.settle(lidar, read.clock_step, now_))
    notices_.note(lidar, change->kind, now_, change->duration);
  if (const auto drift = clocks_.watch(lidar, now_)) notices_.note(lidar, Notice::Kind::ClockDrifts, now_, *drift);
}

void TimeBatcher::replace(LidarIndex lidar, std::shared_ptr<const PacketDecoder> decoder)
{
  lidars_[lidar].decoder = std::move(decoder);
  beginAnew(lidar);
}

std::optional<Duration> TimeBatcher::ahead(LidarIndex lidar, Timestamp stamp, Timestamp received) const
{
  const auto& stream = inputs_[lidar].stream;
  return stream ? stream->ahead(stamp, received) : std::nullopt;
}

/** Nothing that was received from the lidar before is continued. */
void TimeBatcher::beginAnew(LidarIndex lidar)
{
  follow(lidar);
  clocks_[lidar].restarted();
  if (scan_) return;
  // Nothing was given out yet: what waits is of a clock that can't be compared any more.
  inputs_[lidar].counters.before_start += inputs_[lidar].queue.clear();
  refreshFront(lidar);
}

/** Packets are those of the lidar's present decoder from here on. */
void TimeBatcher::follow(LidarIndex lidar)
{
  Input& input = inputs_[lidar];
  const LidarDescription& description = lidars_[lidar].decoder->description();
  if (input.stream) input.stream->giveUpAllGaps(input.counters);
  input.stream.emplace(description, deadline());
  input.presence.emplace(description, period_);
  // The oldest block of a packet under way is one packet's duration older than its newest.
  input.patience = deadline() + description.blockPeriod() * description.columns_per_packet;
}

void TimeBatcher::refreshFront(LidarIndex lidar)
{
  const PacketQueue& queue = inputs_[lidar].queue;
  fronts_[lidar] = queue.empty() ? Timestamp::max() : queue.front().stamp;
}

/**
 * Whose stamps tell what time it is; none while that can't be said of a lidar that sends. What is silent again was
 * another sender or a damaged packet, and is forgotten; what stays thin is not waited for.
 */
std::optional<std::vector<bool>> TimeBatcher::lidarsWithClock()
{
  std::vector<bool> accepted(inputs_.size(), true);
  for (LidarIndex i = 0; i < inputs_.size() && !finished_; ++i)
  {
    const Input& input = inputs_[i];
    if (!input.stream || !input.stream->firstStamp() || input.presence->isEstablished()) continue;
    if (input.presence->isLost(now_))
      beginAnew(i);
    else if (input.presence->isStarting(now_))
      return std::nullopt;
    else
      accepted[i] = false;
  }
  return accepted;
}

void TimeBatcher::startScans()
{
  const std::optional<std::vector<bool>> accepted = lidarsWithClock();
  if (!accepted) return;
  const auto skews = clocks_.skewsAtStart(*accepted);
  std::vector<LidarBeforeStart> lidars;
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    lidars.push_back({std::nullopt, Duration{0}, inputs_[i].patience});
    const auto first = skews[i] ? inputs_[i].stream->firstStamp() : std::nullopt;
    if (!first) continue;
    lidars.back().first_stamp = *first + clocks_[i].offset() + *skews[i];
    lidars.back().delay = *clocks_[i].leastDelay() - *skews[i];
  }
  const auto latest = latestFirstStamp(lidars, period_, finished_ ? std::nullopt : std::optional(now_));
  if (!latest) return;

  settleClocksAtStart(*accepted);
  scan_.emplace(firstStart(*latest), period_, options_.slices, inputs_.size());
}

/**
 * Eq. (1), but a recording of one turn gives all its columns where there is one lidar, and where packets are turns that
 * a program has cut: clouds of a driver.
 */
Timestamp TimeBatcher::firstStart(Timestamp latest_first_stamp) const
{
  const auto sendsTurns = [](const BatchedLidar& lidar)
  {
    return lidar.decoder &&
           lidar.decoder->description().columns_per_packet == lidar.decoder->description().columns_per_frame;
  };
  Duration room{0};
  if (std::all_of(lidars_.begin(), lidars_.end(), sendsTurns))
    room = period_ / 100;
  else if (lidars_.size() == 1)
    room = lidars_.front().decoder->description().blockPeriod();
  return startOfWholeScan(latest_first_stamp, period_, fromSeconds(1e-3 * options_.scan_phase_ms), room);
}

void TimeBatcher::settleClocksAtStart(const std::vector<bool>& accepted)
{
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
    if (!accepted[i]) beginAnew(i);
  for (const LidarClocks::Change& change : clocks_.settleAtStart(accepted, now_))
  {
    const LidarIndex lidar = change.lidar;
    Input& input = inputs_[lidar];
    if (change.kind == Notice::Kind::Quarantined)
      input.counters.quarantined += input.queue.clear();
    else
      input.queue.shift(clocks_[lidar].offset() - clocks_[lidar].configuredOffset());
    notices_.note(lidar, change.kind, now_, change.duration);
    refreshFront(lidar);
  }
}

/** To the smallest watermark: no lidar will deliver a block with an earlier stamp, or is waited for. */
void TimeBatcher::raiseHorizon()
{
  if (const std::optional<Duration> quickest = clocks_.leastDelay())
    for (LidarIndex i = 0; i < inputs_.size(); ++i)
    {
      Input& input = inputs_[i];
      if (input.stream) input.stream->giveUpGaps(now_, input.counters);
      // A lidar that has not sent yet is expected to be as quick as the quickest one.
      const Duration delay = clocks_[i].isUsed() ? clocks_[i].leastDelay().value_or(*quickest) : *quickest;
      input.deadline_mark = std::max(input.deadline_mark, now_ - delay - input.patience);
    }

  Timestamp horizon = Timestamp::max();
  for (LidarIndex i = 0; i < inputs_.size(); ++i) horizon = std::min(horizon, watermark(i));
  const bool all_are_quarantined = horizon == Timestamp::max() && !finished_;
  if (!all_are_quarantined) horizon_ = std::max(horizon_, horizon);
}

Timestamp TimeBatcher::watermark(LidarIndex lidar) const
{
  if (finished_ || clocks_[lidar].state() == LidarClock::State::Quarantined) return Timestamp::max();
  return std::max(sequenceMark(lidar), inputs_[lidar].deadline_mark);
}

/** What the lidar's packets say of those to come. */
Timestamp TimeBatcher::sequenceMark(LidarIndex lidar) const
{
  const auto& stream = inputs_[lidar].stream;
  const std::optional<Timestamp> mark = stream ? stream->watermark() : std::nullopt;
  return mark ? *mark + clocks_[lidar].offset() : Timestamp::min();
}

/** Scans and slices that end at `time` or before: no block for them will come any more. */
void TimeBatcher::closeUntil(Timestamp time, std::vector<Scan>& closed)
{
  while (time >= scan_->end())
  {
    closed.push_back(scan_->close(missingLidars(), on_slice_));
    if (time < scan_->start() + kLongestSilence) continue;
    const std::int64_t skipped = (time - scan_->start()) / period_;
    scan_->skip(skipped);
    for (Input& input : inputs_) input.counters.missed_scans += static_cast<std::uint64_t>(skipped);
  }
  scan_->giveSlicesUntil(time, on_slice_);
}

/** Those whose blocks the scan may lack; counted and, where it has none of them at all, noted. */
SensorMask TimeBatcher::missingLidars()
{
  SensorMask missing;
  const Scan& scan = scan_->scan();
  for (LidarIndex i = 0; i < inputs_.size(); ++i)
  {
    if (sequenceMark(i) >= scan.end() && clocks_[i].state() != LidarClock::State::Quarantined) continue;
    missing.set(i);
    if (finished_) continue;
    ++inputs_[i].counters.missed_scans;
    if (scan.columns_of[i] == 0) notices_.noteSilent(i, now_);
  }
  return missing;
}

void TimeBatcher::takeOldestBlock(LidarIndex lidar)
{
  Input& input = inputs_[lidar];
  switch (scan_->placeOf(input.queue.front(), lidar))
  {
    case ScanUnderConstruction::Place::Next:
      input.counters.points += scan_->append(input.queue, lidar);
      ++input.counters.emitted;
      break;
    case ScanUnderConstruction::Place::Late:
      ++input.counters.late;
      break;
    case ScanUnderConstruction::Place::BeforeStart:
      ++input.counters.before_start;
      break;
  }
  input.queue.pop();
  refreshFront(lidar);
}
}  // namespace scanloom
