#include "SimulatedRig.h"

#include "ExitCode.h"
#include "Settings.h"
#include "source/RigOptions.h"

namespace scanloom
{
Scene checkedScene(const SimulationSettings& settings, std::uint64_t seed)
{
  try
  {
    return makeScene(settings, seed);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(error.what());
  }
}

SimulatedRig simulatedRig(const SceneArguments& arguments, const Configuration& configuration,
                          const std::vector<std::string>& lidars)
{
  const auto settings = readSettings<SimulationSettings>(configuration, knownToAnyVerb());
  const auto scene = std::make_shared<const Scene>(checkedScene(settings, arguments.seed));
  const bool has_rig = hasRigSection(configuration);
  const auto batcher = has_rig ? configuration.read<BatcherOptions>(rigSection(configuration)) : BatcherOptions{};
  try
  {
    return {scene, rigOf(*scene, batcher, lidars)};
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(error.what());
  }
}
}  // namespace scanloom
