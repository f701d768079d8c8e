#include "input/batching/Continuity.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Smaller steps of a clock are ignored. Unevenness of the rotor and the resolution of stamps are well below this.
constexpr double kStepTolerance = 0.002;  // s

// By how much rotors and clocks may deviate from the measured rate during a gap.
constexpr double kRateTolerance = 0.01;

// How much faster or slower than real time a capture may have been replayed.
constexpr double kSilenceTolerance = 0.1;

// By how much a packet may come sooner after the one before than was measured between them, in s and packets: that one
// may have been on its way for longer.
constexpr double kSoonerTolerance = 0.005;
constexpr double kPacketsSooner = 2;

// A stream goes on as long as its next packet is not later than this, in packets.
constexpr double kOverdue = 1.5;

// A clock that counts from its start is half a century off the host's.
constexpr Duration kFarthest{std::chrono::hours{24 * 365 * 90}};

constexpr int kTurnsToReorder = 4;
constexpr std::int64_t kPacketsOfNumberedTurn = 64;
}  // namespace

bool isPlausible(Timestamp stamp, Timestamp received)
{
  return stamp >= Timestamp{} && std::chrono::abs(stamp - received) <= kFarthest;
}

LidarDescription numberedTurn(LidarDescription lidar)
{
  if (lidar.numbering == Numbering::Ids) return lidar;
  lidar.columns_per_frame = static_cast<int>(kPacketsOfNumberedTurn) * lidar.columns_per_packet;
  lidar.first_column = 0;
  lidar.last_column = lidar.columns_per_frame - 1;
  return lidar;
}

Continuity::Continuity(const LidarDescription& lidar)
  : numbering_(lidar.numbering),
    blocks_per_turn_(numberedTurn(lidar).columns_per_frame),
    blocks_per_packet_(lidar.columns_per_packet),
    blocks_of_all_frames_(static_cast<std::int64_t>(lidar.frame_id_modulus) * lidar.columns_per_frame),
    nominal_period_(seconds(lidar.blockPeriod())),
    block_period_(nominal_period_)
{
}

Continuity::Judgement Continuity::judge(const PacketPlace& place, Timestamp received)
{
  if (!latest_)
  {
    if (!place.stamp) return {};
    const std::int64_t block = numbering_ == Numbering::Ids ? nearestBlock(place, 0) : 0;
    latest_ = seen(place, block, received);
    return {Verdict::Continues, block, block, {}};
  }
  if (const auto block = continued(*latest_, place, received))
  {
    follow(place, *block, received);
    return {Verdict::Continues, *block, *block, {}};
  }
  if (!place.stamp) return {};  // a packet without a valid block confirms nothing
  if (candidate_)
    if (const auto block = continued(*candidate_, place, received);
        block && *block != candidate_->block && isOverdue(received))
      return breakConfirmedBy(place, *block, received);
  candidate_ = seen(place, numbering_ == Numbering::Ids ? nearestBlock(place, latest_->block) : 0, received);
  return {};
}

std::optional<Duration> Continuity::ahead(Timestamp stamp, Timestamp received) const
{
  if (!latest_ || !latest_->stamp) return std::nullopt;
  return (stamp - *latest_->stamp) - (received - latest_->received);
}

/** Whether the stream's next packet should have come by now: one that still goes on was not broken by two packets of an
 * unknown sender. */
bool Continuity::isOverdue(Timestamp received) const
{
  return received - latest_->received >=
         fromSeconds(kOverdue * nominal_period_ * static_cast<double>(blocks_per_packet_));
}

/** The number of the packet's last block if the packet belongs to the same stream as `known`. */
std::optional<std::int64_t> Continuity::continued(const Seen& known, const PacketPlace& place, Timestamp received) const
{
  if (known.init_id && place.init_id && *known.init_id != *place.init_id) return std::nullopt;
  return numbering_ == Numbering::Ids ? byIds(known, place, received) : byStamp(known, place, received);
}

std::optional<std::int64_t> Continuity::byIds(const Seen& known, const PacketPlace& place, Timestamp received) const
{
  const std::int64_t near = nearestBlock(place, known.block);
  if (!place.stamp || !known.stamp)
    return std::abs(near - known.block) <= kTurnsToReorder * blocks_per_turn_ ? std::optional(near) : std::nullopt;

  const double elapsed = seconds(*place.stamp - *known.stamp);
  const auto agrees = [&](std::int64_t block)
  { return std::abs(elapsed - secondsOf(block - known.block)) <= kStepTolerance + kRateTolerance * std::abs(elapsed); };
  const double waited = seconds(received - known.received);
  if (std::abs(near - known.block) <= kTurnsToReorder * blocks_per_turn_ && agrees(near))
    // Nobody can have measured what is still to come: an unknown sender's copy would move this lidar's clock ahead.
    return elapsed - waited <= kSoonerTolerance + kPacketsSooner * secondsOf(blocks_per_packet_) +
                                   kSilenceTolerance * std::abs(elapsed)
               ? std::optional(near)
               : std::nullopt;

  // After long silence host time must agree, too; frame ids may have wrapped more than once.
  if (std::abs(waited - elapsed) > seconds(kArrivalTolerance) + kSilenceTolerance * std::abs(waited))
    return std::nullopt;
  const std::int64_t far = nearestBlock(place, known.block + std::llround(elapsed / block_period_));
  return agrees(far) ? std::optional(far) : std::nullopt;
}

std::optional<std::int64_t> Continuity::byStamp(const Seen& known, const PacketPlace& place, Timestamp received) const
{
  if (!place.stamp || !known.stamp) return std::nullopt;
  const Duration elapsed = *place.stamp - *known.stamp;
  const Duration waited = received - known.received;
  if (elapsed - waited > kArrivalTolerance || waited - elapsed > kArrivalTolerance) return std::nullopt;
  const double packets = seconds(elapsed) / secondsOf(blocks_per_packet_);
  return known.block + blocks_per_packet_ * std::llround(packets);
}

/** Frame ids wrap: of all block numbers that fit the ids, the one nearest to `to`. */
std::int64_t Continuity::nearestBlock(const PacketPlace& place, std::int64_t to) const
{
  const std::int64_t block = place.frame_id * blocks_per_turn_ + place.measurement_id;
  const double rounds = static_cast<double>(to - block) / static_cast<double>(blocks_of_all_frames_);
  return block + std::llround(rounds) * blocks_of_all_frames_;
}

/** The packet continues the doubtful one before it: a restart or a step happened between that one and the one before.
 */
Continuity::Judgement Continuity::breakConfirmedBy(const PacketPlace& place, std::int64_t block, Timestamp received)
{
  const bool other_run = latest_->init_id && place.init_id && *latest_->init_id != *place.init_id;
  const std::int64_t advance = block - latest_->block;
  const bool ids_go_on = numbering_ == Numbering::Stamps || std::abs(advance) <= kTurnsToReorder * blocks_per_turn_;
  Judgement judgement{Verdict::Restarts, block, candidate_->block, {}};
  if (!other_run && ids_go_on && latest_->stamp)
  {
    judgement.verdict = Verdict::ClockSteps;
    if (numbering_ == Numbering::Stamps)
    {
      const Duration waited = received - latest_->received;
      judgement.block =
          latest_->block +
          std::max<std::int64_t>(1, std::llround(seconds(waited) / secondsOf(blocks_per_packet_))) * blocks_per_packet_;
    }
    judgement.step = (*place.stamp - *latest_->stamp) - fromSeconds(secondsOf(judgement.block - latest_->block));
    // The doubtful packet only came sooner than expected: packets before it are lost.
    if (std::abs(seconds(judgement.step)) <= kStepTolerance) judgement.verdict = Verdict::Continues;
  }
  latest_ = seen(place, judgement.block, received);
  candidate_.reset();
  return judgement;
}

void Continuity::follow(const PacketPlace& place, std::int64_t block, Timestamp received)
{
  const std::int64_t advance = block - latest_->block;
  if (advance <= 0) return;
  if (numbering_ == Numbering::Ids && place.stamp && latest_->stamp && advance <= 2 * blocks_per_packet_)
  {
    const double measured = seconds(*place.stamp - *latest_->stamp) / static_cast<double>(advance);
    block_period_ += (std::clamp(measured, nominal_period_ / 4, nominal_period_ * 4) - block_period_) / 32;
  }
  const std::optional<Timestamp> before = latest_->stamp;
  Seen known = seen(place, block, received);
  if (!known.stamp && before) known.stamp = *before + fromSeconds(secondsOf(advance));
  if (!known.init_id) known.init_id = latest_->init_id;
  latest_ = known;
  candidate_.reset();
}

Continuity::Seen Continuity::seen(const PacketPlace& place, std::int64_t block, Timestamp received) const
{
  return {place.init_id, block, place.stamp, received};
}
}  // namespace scanloom
