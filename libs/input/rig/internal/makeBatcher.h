#pragma once
#include "input/batching/Batcher.h"

#include <memory>
#include <vector>

namespace scanloom
{
/**
 * The batcher that options.batching names: by time, or whole turns to compare it with. Throws std::invalid_argument for
 * another name and for slices of whole turns, and what the constructors throw.
 */
std::unique_ptr<Batcher> makeBatcher(const std::vector<BatchedLidar>&, const BatcherOptions&);
}  // namespace scanloom
