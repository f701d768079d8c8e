#include "batching/TurnCollector.h"

namespace scanloom
{
Turn TurnCollector::emptyTurn()
{
  Turn turn;
  if (spare_.empty()) return turn;
  turn.points = std::move(spare_.back().points);
  turn.columns = std::move(spare_.back().columns);
  spare_.pop_back();
  turn.points.clear();
  turn.columns.clear();
  return turn;
}
}  // namespace scanloom
