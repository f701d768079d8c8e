#pragma once
#include "mrpt_bridge/SensorInput.h"

namespace scanloom
{
/**
 * The same events in the same order, read by a thread of its own while the caller works on those before. For inputs
 * that let nobody wait. The thread starts with the first next(), so that what the input knows of its IMUs before does
 * not depend on how fast it reads; it is `scans` scans ahead at most. What the input throws, next() throws after the
 * events before.
 */
std::unique_ptr<SensorInput> readAhead(std::unique_ptr<SensorInput>, std::size_t scans = 2);
}  // namespace scanloom
