#include "input/rig/internal/makeBatcher.h"

#include "input/batching/TimeBatcher.h"
#include "input/whole_turns/WholeTurns.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
std::unique_ptr<Batcher> makeBatcher(const std::vector<BatchedLidar>& lidars, const BatcherOptions& options)
{
  if (options.batching == "time") return std::make_unique<TimeBatcher>(lidars, options);
  if (options.slices > 1)
    throw std::invalid_argument(fmt::format("slices = {} with batching = {}: only scans by time have slices",
                                            options.slices, options.batching));
  if (options.batching == "nearest_turns") return std::make_unique<WholeTurns>(lidars, TurnGrouping::Nearest);
  if (options.batching == "one_turn_of_each") return std::make_unique<WholeTurns>(lidars, TurnGrouping::OneOfEach);
  throw std::invalid_argument(
      fmt::format("batching = {}: must be time, nearest_turns or one_turn_of_each", options.batching));
}
}  // namespace scanloom
