#include "base/core/unwrapped.h"
#include "input/lidar/AzimuthWindow.h"
#include "input/whole_turns/internal/TurnCollector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
// A lidar whose rotor stands still never completes a turn: one is cut after this many nominal turns.
constexpr int kLongestTurn = 2;

class AzimuthTurns : public TurnCollector
{
 public:
  AzimuthTurns(std::shared_ptr<const PacketDecoder> decoder, Duration time_offset, std::uint8_t sensor_id)
    : decoder_(std::move(decoder)), time_offset_(time_offset), sensor_id_(sensor_id)
  {
  }

  std::vector<Turn> push(const RoutedPacket& packet, LidarCounters& count) override
  {
    std::vector<Turn> over;
    for (MeasurementBlock block : packet.blocks)
    {
      if (!block.valid) continue;
      restartAfterJump(block.stamp, packet.received, over, count);
      block.stamp = unwrappedStamp(block.stamp, packet.received);
      if (newest_ && block.stamp <= newest_->stamp)
      {
        ++count.late;
        continue;
      }
      const std::uint64_t missing = newest_ ? missingBefore(block) : 0;
      count.lost += missing;
      if (!newest_) turn_.whole = false;  // its beginning may have been sent before
      if (newest_ && isNextTurn(block)) giveOut(missing == 0, over);
      turn_.whole = turn_.whole && missing == 0;
      turn_.add(*decoder_, packet.bytes, block, sensor_id_);
      newest_ = block;
    }
    return over;
  }

  std::vector<Turn> finish(LidarCounters&) override
  {
    std::vector<Turn> over;
    if (!turn_.columns.empty()) giveOut(false, over);
    return over;
  }

  std::optional<Timestamp> underWaySince() const override
  {
    if (turn_.columns.empty()) return std::nullopt;
    return turn_.first;
  }

 private:
  const LidarDescription& lidar() const { return decoder_->description(); }

  /** A stamp many turns away from the newest is of another clock: the lidar has started again. */
  void restartAfterJump(Timestamp raw_stamp, Timestamp received, std::vector<Turn>& over, LidarCounters& count)
  {
    if (!newest_) return;
    const Duration jump = std::chrono::abs(unwrappedStamp(raw_stamp, received) - newest_->stamp);
    if (seconds(jump) * lidar().frame_rate <= kTurnsRemembered) return;
    ++count.restarts;
    newest_.reset();
    if (!turn_.columns.empty()) giveOut(false, over);
  }

  Timestamp unwrappedStamp(Timestamp stamp, Timestamp received) const
  {
    return unwrapped(stamp + time_offset_, lidar().stamp_modulus, newest_ ? newest_->stamp : received);
  }

  /**
   * How many blocks fit between the newest and this one, without those outside of the azimuth window. Rounded to whole
   * packets: a rotor that is not quite even, or a window's rounded edge, is no loss.
   */
  std::uint64_t missingBefore(const MeasurementBlock& block) const
  {
    const double blocks = seconds(block.stamp - newest_->stamp) / seconds(lidar().blockPeriod()) - 1;
    if (blocks < 0.5 * lidar().columns_per_packet) return 0;
    int outside = 0;
    const int columns = lidar().columns_per_frame;
    for (int id = (newest_->measurement_id + 1) % columns; id != block.measurement_id; id = (id + 1) % columns)
      outside += !inAzimuthWindow(lidar(), id);
    const std::int64_t packets = std::llround((blocks - outside) / lidar().columns_per_packet);
    return static_cast<std::uint64_t>(std::max<std::int64_t>(packets, 0) * lidar().columns_per_packet);
  }

  bool isNextTurn(const MeasurementBlock& block) const
  {
    const bool zero_in_window = lidar().first_column > lidar().last_column;
    const int ids = zero_in_window ? lidar().columns_per_frame : lidar().last_column - lidar().first_column + 1;
    return newest_->measurement_id - block.measurement_id > ids / 2 ||
           seconds(block.stamp - turn_.first) * lidar().frame_rate > kLongestTurn;
  }

  void giveOut(bool ended, std::vector<Turn>& over)
  {
    turn_.whole = turn_.whole && ended;
    over.push_back(std::exchange(turn_, emptyTurn(turn_.points.size())));
  }

  std::shared_ptr<const PacketDecoder> decoder_;
  Duration time_offset_;
  std::uint8_t sensor_id_;
  std::optional<MeasurementBlock> newest_;
  Turn turn_;  // under way, if it has columns
};
}  // namespace

std::unique_ptr<TurnCollector> makeAzimuthTurns(std::shared_ptr<const PacketDecoder> decoder, Duration time_offset,
                                                std::uint8_t sensor_id)
{
  return std::make_unique<AzimuthTurns>(std::move(decoder), time_offset, sensor_id);
}
}  // namespace scanloom
