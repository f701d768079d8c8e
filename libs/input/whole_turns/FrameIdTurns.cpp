#include "input/whole_turns/internal/TurnCollector.h"

#include <algorithm>

namespace scanloom
{
namespace
{
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

std::uint64_t validOnes(const std::vector<MeasurementBlock>& blocks)
{
  return static_cast<std::uint64_t>(std::count_if(blocks.begin(), blocks.end(), [](const auto& b) { return b.valid; }));
}

/** The newest turn. After it was given out, `arrived` still tells which packets come twice or late. */
struct NewestTurn
{
  std::uint32_t frame_id = 0;
  std::size_t first_expected = 0;  // packets before this one may have been sent before we listened
  std::vector<bool> arrived;       // by packet of the turn
  std::optional<Turn> turn;
};

class FrameIdTurns : public TurnCollector
{
 public:
  FrameIdTurns(std::shared_ptr<const PacketDecoder> decoder, Duration time_offset, std::uint8_t sensor_id)
    : decoder_(std::move(decoder)),
      time_offset_(time_offset),
      sensor_id_(sensor_id),
      sent_(packetsSent(decoder_->description()))
  {
  }

  std::vector<Turn> push(const RoutedPacket& packet, LidarCounters& count) override
  {
    // Blocks that are not valid may have any ids: they are used only where a packet has no valid block.
    const std::vector<MeasurementBlock>& blocks = packet.blocks;
    const auto valid = std::find_if(blocks.begin(), blocks.end(), [](const auto& b) { return b.valid; });
    const MeasurementBlock& block = valid != blocks.end() ? *valid : blocks.front();
    const auto place = static_cast<std::size_t>(block.measurement_id / decoder_->description().columns_per_packet);
    if (place >= sent_.size()) return {};

    std::vector<Turn> over;
    startTurnOf(packet.header, block.frame_id, place, over, count);
    if (turnsAhead(block.frame_id) < 0 || (!newest_->turn && !newest_->arrived[place]))
      count.late += validOnes(blocks);
    else if (newest_->arrived[place])
      count.duplicate += validOnes(blocks);
    else
    {
      newest_->arrived[place] = true;
      addColumns(packet, count);
      if (missingUntil(sent_.size()) == 0) giveOut(sent_.size(), over, count);
    }
    return over;
  }

  std::vector<Turn> finish(LidarCounters& count) override
  {
    std::vector<Turn> over;
    if (!newest_) return over;
    const auto last = std::find(newest_->arrived.rbegin(), newest_->arrived.rend(), true);
    giveOut(static_cast<std::size_t>(newest_->arrived.rend() - last), over, count);
    return over;
  }

  std::optional<Timestamp> underWaySince() const override
  {
    if (!newest_ || !newest_->turn || newest_->turn->columns.empty()) return std::nullopt;
    return newest_->turn->first;
  }

 private:
  /** Begins the packet's turn if it is later than the newest one, which is then given out. */
  void startTurnOf(const PacketHeader& header, std::uint32_t frame_id, std::size_t place, std::vector<Turn>& over,
                   LidarCounters& count)
  {
    const bool other_run = header.init_id && init_id_ && *header.init_id != *init_id_;
    if (header.init_id) init_id_ = header.init_id;
    const std::int64_t ahead = newest_ ? turnsAhead(frame_id) : 0;
    if (!newest_)
      beginTurn(frame_id, place);
    else if (other_run || std::abs(ahead) > kTurnsRemembered)
    {
      ++count.restarts;
      giveOut(0, over, count);
      beginTurn(frame_id, place);
    }
    else if (ahead > 0)
    {
      giveOut(sent_.size(), over, count);
      count.lost += static_cast<std::uint64_t>((ahead - 1) * std::count(sent_.begin(), sent_.end(), true) *
                                               decoder_->description().columns_per_packet);
      beginTurn(frame_id, 0);
    }
  }

  std::int64_t turnsAhead(std::uint32_t frame_id) const
  {
    const auto modulus = static_cast<std::int64_t>(decoder_->description().frame_id_modulus);
    const std::int64_t ahead = (static_cast<std::int64_t>(frame_id) - newest_->frame_id) % modulus;
    if (ahead < -modulus / 2) return ahead + modulus;
    return ahead >= modulus / 2 ? ahead - modulus : ahead;
  }

  void beginTurn(std::uint32_t frame_id, std::size_t first_expected)
  {
    newest_ = NewestTurn{frame_id, first_expected, std::vector<bool>(sent_.size()), emptyTurn(points_of_latest_turn_)};
  }

  void addColumns(const RoutedPacket& packet, LidarCounters& count)
  {
    // A stamp this far from the others of its turn is damaged.
    const Duration furthest = 2 * decoder_->description().blockPeriod() * decoder_->description().columns_per_frame;
    Turn& turn = *newest_->turn;
    for (MeasurementBlock block : packet.blocks)
    {
      if (!block.valid) continue;
      block.stamp += time_offset_;
      if (!turn.columns.empty() && std::chrono::abs(block.stamp - turn.origin) > furthest)
        ++count.implausible;
      else
        turn.add(*decoder_, packet.bytes, block, sensor_id_);
    }
  }

  std::size_t missingUntil(std::size_t end) const
  {
    std::size_t missing = 0;
    for (std::size_t i = newest_->first_expected; i < end; ++i) missing += sent_[i] && !newest_->arrived[i];
    return missing;
  }

  /** The newest turn is over; its packets before `expected_until` have been sent. */
  void giveOut(std::size_t expected_until, std::vector<Turn>& over, LidarCounters& count)
  {
    if (!newest_->turn) return;
    Turn turn = std::move(*newest_->turn);
    newest_->turn.reset();
    points_of_latest_turn_ = turn.points.size();
    const auto first_sent = static_cast<std::size_t>(std::find(sent_.begin(), sent_.end(), true) - sent_.begin());
    turn.whole = newest_->first_expected <= first_sent && missingUntil(sent_.size()) == 0;
    count.lost += missingUntil(expected_until) * static_cast<std::size_t>(decoder_->description().columns_per_packet);
    if (!turn.columns.empty()) over.push_back(std::move(turn));
  }

  std::shared_ptr<const PacketDecoder> decoder_;
  Duration time_offset_;
  std::uint8_t sensor_id_;
  std::vector<bool> sent_;  // by packet of a turn
  std::optional<NewestTurn> newest_;
  std::optional<std::uint32_t> init_id_;
  std::size_t points_of_latest_turn_ = 0;
};
}  // namespace

std::unique_ptr<TurnCollector> makeFrameIdTurns(std::shared_ptr<const PacketDecoder> decoder, Duration time_offset,
                                                std::uint8_t sensor_id)
{
  return std::make_unique<FrameIdTurns>(std::move(decoder), time_offset, sensor_id);
}
}  // namespace scanloom
