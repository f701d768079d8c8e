#include "batching/TurnCollector.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// A frame id that differs by more is not of a neighbouring turn: the lidar has started again.
constexpr std::int64_t kTurnsRemembered = 4;

/** By packet of a turn: whether some of its columns lie within the azimuth window. */
std::vector<bool> packetsSent(const LidarDescription& lidar)
{
  const auto packet_of = [&lidar](int column) { return static_cast<std::size_t>(column / lidar.columns_per_packet); };
  std::vector<bool> sent(packet_of(lidar.columns_per_frame - 1) + 1);
  int column = lidar.first_column;
  for (sent[packet_of(column)] = true; column != lidar.last_column; sent[packet_of(column)] = true)
    column = (column + 1) % lidar.columns_per_frame;
  return sent;
}

/** Whether it is a lidar packet; if not, it is counted for what it is. */
bool isLidarPacket(PacketKind kind, LidarCounters& count)
{
  switch (kind)
  {
    case PacketKind::Lidar:
      return true;
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
  return false;
}
}  // namespace

TurnCollector::TurnCollector(std::shared_ptr<const PacketDecoder> decoder, Duration time_offset, std::uint8_t sensor_id)
  : decoder_(std::move(decoder)),
    time_offset_(time_offset),
    sensor_id_(sensor_id),
    period_(fromSeconds(1 / decoder_->description().frame_rate)),
    sent_(packetsSent(decoder_->description()))
{
}

std::vector<Turn> TurnCollector::push(Bytes packet, LidarCounters& count)
{
  if (!isLidarPacket(decoder_->kind(packet), count)) return {};
  decoder_->readBlocks(packet, blocks_);
  if (blocks_.empty()) return {};
  ++count.packets;
  count.received += blocks_.size();

  // Blocks that are not valid may bear any ids; those of a packet without valid ones are all there is.
  const auto isValid = [](const MeasurementBlock& block) { return block.valid; };
  const auto valid = std::find_if(blocks_.begin(), blocks_.end(), isValid);
  const auto usable = static_cast<std::uint64_t>(std::count_if(blocks_.begin(), blocks_.end(), isValid));
  count.invalid += blocks_.size() - usable;
  const MeasurementBlock& block = valid != blocks_.end() ? *valid : blocks_.front();
  const auto packet_of_turn =
      static_cast<std::size_t>(block.measurement_id / decoder_->description().columns_per_packet);
  if (packet_of_turn >= sent_.size()) return {};

  std::vector<Turn> over = startTurnOf(decoder_->header(packet), block.frame_id, packet_of_turn, count);
  if (turnsAhead(block.frame_id) < 0 || (!newest_->turn && !newest_->arrived[packet_of_turn]))
    count.late += usable;
  else if (newest_->arrived[packet_of_turn])
    count.duplicate += usable;
  else
  {
    newest_->arrived[packet_of_turn] = true;
    addColumns(packet, count);
    if (missingUntil(sent_.size()) == 0) giveOut(sent_.size(), over, count);
  }
  return over;
}

/** Begins the packet's turn if it is later than the newest, which then is over. */
std::vector<Turn> TurnCollector::startTurnOf(const PacketHeader& header, std::uint32_t frame_id,
                                             std::size_t packet_of_turn, LidarCounters& count)
{
  const bool other_run = header.init_id && init_id_ && *header.init_id != *init_id_;
  if (header.init_id) init_id_ = header.init_id;

  std::vector<Turn> over;
  const std::int64_t ahead = newest_ ? turnsAhead(frame_id) : 0;
  if (!newest_ || other_run || std::abs(ahead) > kTurnsRemembered)
  {
    if (newest_)
    {
      ++count.restarts;
      giveOut(0, over, count);
    }
    beginTurn(frame_id, packet_of_turn);
  }
  else if (ahead > 0)
  {
    giveOut(sent_.size(), over, count);
    const auto packets_per_turn = static_cast<std::uint64_t>(std::count(sent_.begin(), sent_.end(), true));
    count.lost += static_cast<std::uint64_t>(ahead - 1) * packets_per_turn * blocks_.size();
    beginTurn(frame_id, 0);
  }
  return over;
}

std::int64_t TurnCollector::turnsAhead(std::uint32_t frame_id) const
{
  const auto modulus = static_cast<std::int64_t>(decoder_->description().frame_id_modulus);
  const std::int64_t ahead = (static_cast<std::int64_t>(frame_id) - newest_->frame_id) % modulus;
  if (ahead < -modulus / 2) return ahead + modulus;
  return ahead >= modulus / 2 ? ahead - modulus : ahead;
}

void TurnCollector::beginTurn(std::uint32_t frame_id, std::size_t first_expected)
{
  newest_.emplace();
  newest_->frame_id = frame_id;
  newest_->arrived.resize(sent_.size());
  newest_->first_expected = first_expected;
}

void TurnCollector::addColumns(Bytes packet, LidarCounters& count)
{
  Turn& turn = *newest_->turn;
  for (MeasurementBlock block : blocks_)
  {
    if (!block.valid) continue;
    block.stamp += time_offset_;
    if (turn.columns.empty()) turn.first = turn.last = turn.origin = block.stamp;
    if (block.stamp < turn.origin - 2 * period_ || block.stamp > turn.origin + 2 * period_)
    {
      ++count.implausible;
      continue;
    }
    Column column;
    column.stamp = block.stamp;
    column.first_point = static_cast<std::uint32_t>(turn.points.size());
    column.measurement_id = block.measurement_id;
    column.frame_id = block.frame_id;
    column.sensor_id = sensor_id_;
    const auto t = static_cast<std::int32_t>((block.stamp - turn.origin).count());
    decoder_->appendPoints(packet, block.index, t, sensor_id_, turn.points);
    column.count = static_cast<std::uint16_t>(turn.points.size() - column.first_point);
    turn.columns.push_back(column);
    turn.first = std::min(turn.first, block.stamp);
    turn.last = std::max(turn.last, block.stamp);
  }
}

std::size_t TurnCollector::missingUntil(std::size_t end) const
{
  std::size_t missing = 0;
  for (std::size_t i = newest_->first_expected; i < end; ++i) missing += sent_[i] && !newest_->arrived[i];
  return missing;
}

/** The newest turn is over; its packets before `expected_until` have been sent. */
void TurnCollector::giveOut(std::size_t expected_until, std::vector<Turn>& over, LidarCounters& count)
{
  if (!newest_->turn) return;
  Turn turn = std::move(*newest_->turn);
  newest_->turn.reset();
  const auto columns_per_packet = static_cast<std::uint64_t>(decoder_->description().columns_per_packet);
  count.lost += missingUntil(expected_until) * columns_per_packet;
  const auto first_sent = static_cast<std::size_t>(std::find(sent_.begin(), sent_.end(), true) - sent_.begin());
  turn.whole = newest_->first_expected <= first_sent && missingUntil(sent_.size()) == 0;
  if (!turn.columns.empty()) over.push_back(std::move(turn));
}

std::vector<Turn> TurnCollector::finish(LidarCounters& count)
{
  std::vector<Turn> over;
  if (!newest_) return over;
  const auto last = std::find(newest_->arrived.rbegin(), newest_->arrived.rend(), true);
  giveOut(static_cast<std::size_t>(newest_->arrived.rend() - last), over, count);
  return over;
}

std::optional<Timestamp> TurnCollector::underWaySince() const
{
  if (!newest_ || !newest_->turn || newest_->turn->columns.empty()) return std::nullopt;
  return newest_->turn->first;
}
}  // namespace scanloom
