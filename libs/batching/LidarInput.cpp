#include "batching/LidarInput.h"

#include <algorithm>
#include <cmath>

#include "batching/PacketConsensus.h"

namespace scanloom
{
namespace
{
// A clock that counts from its start is half a century off the host's. Sums of a few such differences fit 64 bits.
constexpr Duration kFarthest{std::chrono::hours{24 * 365 * 90}};

bool isPlausible(Timestamp stamp, Timestamp received)
{
  return stamp >= Timestamp{} && std::chrono::abs(stamp - received) <= kFarthest;
}

std::uint32_t flagsOf(const PacketHeader& header)
{
  return header.alert_flags | std::uint32_t{header.thermal_status} << 8 |
         std::uint32_t{header.shot_limiting_status} << 16;
}
}  // namespace

LidarInput::LidarInput(const BatchedLidar& lidar, const BatcherOptions& options)
  : queue(static_cast<std::size_t>(options.queue_packets)),
    clock(lidar.time_offset),
    deadline_(fromSeconds(1e-3 * options.deadline_ms))
{
  if (lidar.decoder) replace(lidar.decoder);
}

void LidarInput::replace(std::shared_ptr<const PacketDecoder> decoder)
{
  giveUpAll();
  decoders_.push_back(std::move(decoder));
  decoder_ = decoders_.back().get();
  const LidarDescription& description = decoder_->description();
  blocks_per_packet_ = static_cast<std::size_t>(description.columns_per_packet);
  packet_time_ = description.blockPeriod() * description.columns_per_packet;
  continuity_.emplace(description);
  sequencer_.emplace(description, deadline_);
  clock.restarted();
  first_stamp_.reset();
  delay_.reset();
}

bool LidarInput::read(Bytes packet, Timestamp received, std::vector<Notice::Kind>& news)
{
  if (!isLidarPacket(packet)) return false;
  readBlocks(packet, received);
  const PacketHeader header = decoder_->header(packet);
  const PacketPlace place = placeOf(header);

  const Continuity::Judgement judged = continuity_->judge(place, received);
  if (judged.verdict == Continuity::Verdict::Doubtful && !blocks_.empty())
  {
    ++counters.doubtful_packets;
    return false;
  }
  noteFlags(header, news);
  breakStream(judged, news);
  ++counters.packets;
  counters.received += blocks_.size() + invalid_ + implausible_;
  counters.invalid += invalid_;
  counters.implausible += implausible_;
  if (judged.verdict == Continuity::Verdict::Doubtful) return false;
  if (!countedOnce(judged.block, place, received) || blocks_.empty()) return false;

  hear(received);
  first_stamp_ = std::min(first_stamp_.value_or(Timestamp::max()), blocks_.front().stamp);
  return true;
}

void LidarInput::hear(Timestamp received)
{
  clock.observe(blocks_.back().stamp, received);
  silence_ = heard_ ? received - *heard_ : Duration{0};
  heard_ = received;
}

bool LidarInput::isLidarPacket(Bytes packet)
{
  return countUnlessLidar(decoder_ ? decoder_->kind(packet) : PacketKind::Other, counters);
}

/** The blocks that are valid and agree with each other; the others are counted. */
void LidarInput::readBlocks(Bytes packet, Timestamp received)
{
  decoder_->readBlocks(packet, blocks_);
  const LidarDescription& description = decoder_->description();
  const std::size_t all = blocks_.size();
  any_block_ = blocks_.empty() ? MeasurementBlock{} : blocks_.front();
  const auto dropImplausible = [&]
  {
    for (MeasurementBlock& block : blocks_) block.valid = block.valid && isPlausible(block.stamp, received);
  };
  for (MeasurementBlock& block : blocks_)
    block.valid = block.valid && block.measurement_id < description.columns_per_frame;
  dropImplausible();
  if (description.stamp_modulus > Duration{0})
  {
    unwrapStamps(received);
    dropImplausible();
  }
  implausible_ = keepAgreeing(blocks_, description.numbering, continuity_->blockPeriod());
  invalid_ = all - implausible_ - blocks_.size();
}

/** Nearest to host time at first, then so that no step of up to half a round shows. */
void LidarInput::unwrapStamps(Timestamp received)
{
  const Duration round = decoder_->description().stamp_modulus;
  const Timestamp expected = received - delay_.value_or(Duration{0});
  for (MeasurementBlock& block : blocks_)
    if (block.valid) block.stamp += std::llround(seconds(expected - block.stamp) / seconds(round)) * round;
  const auto last = std::find_if(blocks_.rbegin(), blocks_.rend(), [](const MeasurementBlock& b) { return b.valid; });
  if (last != blocks_.rend()) delay_ = received - last->stamp;
}

PacketPlace LidarInput::placeOf(const PacketHeader& header) const
{
  PacketPlace place;
  place.init_id = header.init_id;
  place.frame_id = blocks_.empty() ? any_block_.frame_id : blocks_.back().frame_id;
  place.measurement_id = blocks_.empty() ? any_block_.measurement_id : blocks_.back().measurement_id;
  if (!blocks_.empty()) place.stamp = blocks_.back().stamp;
  return place;
}

void LidarInput::noteFlags(const PacketHeader& header, std::vector<Notice::Kind>& news)
{
  const std::uint32_t flags = flagsOf(header);
  if (flags != 0) ++counters.alert_packets;
  if (flags != flags_) news.push_back(Notice::Kind::Alert);
  flags_ = flags;
}

void LidarInput::breakStream(const Continuity::Judgement& judged, std::vector<Notice::Kind>& news)
{
  if (judged.verdict == Continuity::Verdict::Restarts)
  {
    ++counters.restarts;
    counters.lost += sequencer_->restart(judged.first_block) * blocks_per_packet_;
    clock.restarted();
    first_stamp_.reset();
    news.push_back(Notice::Kind::Restarted);
  }
  if (judged.verdict == Continuity::Verdict::ClockSteps)
  {
    ++counters.clock_steps;
    step_ = judged.step;
    sequencer_->shift(step_);
    clock.stepped(step_);
    if (first_stamp_) *first_stamp_ += step_;
    news.push_back(Notice::Kind::ClockStepped);
  }
}

/** False for a repeated packet, which is counted. */
bool LidarInput::countedOnce(std::int64_t last_block, const PacketPlace& place, Timestamp received)
{
  switch (sequencer_->accept({last_block, place.stamp, continuity_->blockPeriod()}, received))
  {
    case Sequencer::Verdict::New:
      return true;
    case Sequencer::Verdict::Recovered:
      counters.lost -= blocks_per_packet_;
      return true;
    case Sequencer::Verdict::Duplicate:
      counters.duplicate += blocks_.size();
      return false;
  }
  return false;
}

void LidarInput::enqueue(Bytes packet)
{
  for (MeasurementBlock& block : blocks_) block.stamp += clock.offset();
  counters.dropped += queue.push(packet, blocks_, *decoder_);
}

void LidarInput::quarantine() { counters.quarantined += blocks_.size(); }

void LidarInput::giveUpGaps(Timestamp now)
{
  if (sequencer_) counters.lost += sequencer_->giveUpGaps(now) * blocks_per_packet_;
}

void LidarInput::giveUpAll()
{
  if (sequencer_) counters.lost += sequencer_->finish() * blocks_per_packet_;
}

std::optional<Timestamp> LidarInput::sequenceMark() const
{
  const std::optional<Timestamp> mark = sequencer_ ? sequencer_->watermark() : std::nullopt;
  return mark ? std::optional(*mark + clock.offset()) : std::nullopt;
}

void LidarInput::raiseDeadline(Timestamp now, Duration delay)
{
  deadline_mark_ = std::max(deadline_mark_, deadlineAt(now, delay));
}

Timestamp LidarInput::deadlineAt(Timestamp now, Duration delay) const
{
  // The oldest block of a packet under way is one packet's duration older than its newest.
  return now - delay - packet_time_ - deadline_;
}

std::optional<Timestamp> LidarInput::firstStamp() const
{
  return first_stamp_ ? std::optional(*first_stamp_ + clock.offset()) : std::nullopt;
}
}  // namespace scanloom
