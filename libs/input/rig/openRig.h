#pragma once
#include "input/rig/SensorInput.h"

#include <memory>

namespace scanloom
{
struct Rig;

/** RigReplay of the rig's captures; if it has none, RigTopics or RigLive. Throws what their constructors throw. */
std::unique_ptr<SensorInput> openRig(const Rig&);
}  // namespace scanloom
