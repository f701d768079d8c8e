#pragma once
#include "input/rig/SensorInput.h"

#include <memory>

namespace scanloom
{
struct Rig;

/** RigReplay of the rig's captures, or RigLive if it has none. Throws what their constructors throw. */
std::unique_ptr<SensorInput> openRig(const Rig&);
}  // namespace scanloom
