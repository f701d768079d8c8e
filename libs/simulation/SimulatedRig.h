/** A simulated drive in place of a recording: what `--simulate` of a verb reads. */
#pragma once
#include "config/Configuration.h"
#include "simulation/SceneInput.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/** Throws UsageError if options that are within their bounds contradict each other. */
Scene checkedScene(const SimulationSettings&, std::uint64_t seed);

struct SimulatedRig
{
  std::shared_ptr<const Scene> scene;
  Rig rig;
};

/**
 * The scene of the sections [simulated_...], and the rig that reads it. The batcher's options are those of the section
 * of lidars, if there is one.
 * @param lidars names of those to use; empty: all. Throws ConfigError, or UsageError as checkedScene does.
 */
SimulatedRig simulatedRig(const Configuration&, std::uint64_t seed, const std::vector<std::string>& lidars);
}  // namespace scanloom
