#include "simulation/SimulatedRig.h"

#include "core/ConfigError.h"
#include "rig/RigOptions.h"

#include <stdexcept>

namespace scanloom
{
namespace
{
template <typename Make>
auto orUsageError(const Make& make)
try
{
  return make();
}
catch (const std::invalid_argument& error)
{
  throw UsageError(error.what());
}
}  // namespace

Scene checkedScene(const SimulationSettings& settings, std::uint64_t seed)
{
  return orUsageError([&] { return makeScene(settings, seed); });
}

SimulatedRig simulatedRig(const Configuration& configuration, std::uint64_t seed,
                          const std::vector<std::string>& lidars)
{
  const auto scene = std::make_shared<const Scene>(checkedScene(readSettings<SimulationSettings>(configuration), seed));
  const bool has_rig = hasRigSection(configuration);
  const auto batcher = has_rig ? configuration.read<BatcherOptions>(rigSection(configuration)) : BatcherOptions{};
  return orUsageError([&] { return SimulatedRig{scene, rigOf(*scene, batcher, lidars)}; });
}
}  // namespace scanloom
