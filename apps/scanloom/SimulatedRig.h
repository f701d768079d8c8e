/** A simulated drive as the input of a verb that reads recordings. */
#pragma once
#include "Arguments.h"
#include "simulation/SceneInput.h"

#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/** What is within the bounds of each option and yet impossible together is a wrong configuration: UsageError. */
Scene checkedScene(const SimulationSettings&, std::uint64_t seed);

struct SimulatedRig
{
  std::shared_ptr<const Scene> scene;
  Rig rig;
};

/**
 * The scene of `arguments.file`, whose sections have been added to `configuration`, with the batcher of its section of
 * lidars, if it has one. Throws ConfigError.
 */
SimulatedRig simulatedRig(const SceneArguments&, const Configuration&, const std::vector<std::string>& lidars);
}  // namespace scanloom
