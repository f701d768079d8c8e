#include "lab/simulation/checkedScene.h"

#include "base/core/ConfigError.h"

#include <stdexcept>

namespace scanloom
{
Scene checkedScene(const SimulationSettings& settings, std::uint64_t seed)
try
{
  return makeScene(settings, seed);
}
catch (const std::invalid_argument& error)
{
  throw UsageError(error.what());
}
}  // namespace scanloom
