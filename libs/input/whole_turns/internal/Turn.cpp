#include "input/whole_turns/internal/Turn.h"

#include <algorithm>

namespace scanloom
{
void Turn::add(const PacketDecoder& decoder, Bytes packet, const MeasurementBlock& block, std::uint8_t sensor_id)
{
  if (columns.empty()) origin = first = last = block.stamp;
  first = std::min(first, block.stamp);
  last = std::max(last, block.stamp);

  Column column;
  column.stamp = block.stamp;
  column.first_point = static_cast<std::uint32_t>(points.size());
  column.measurement_id = block.measurement_id;
  column.frame_id = block.frame_id;
  column.sensor_id = sensor_id;
  decoder.appendPoints(packet, block.index, static_cast<std::int32_t>((block.stamp - origin).count()), sensor_id,
                       points);
  column.count = static_cast<std::uint16_t>(points.size() - column.first_point);
  columns.push_back(column);
}

Turn emptyTurn(std::size_t points_of_turn_before)
{
  Turn turn;
  turn.points.reserve(points_of_turn_before + points_of_turn_before / 16);
  return turn;
}
}  // namespace scanloom
