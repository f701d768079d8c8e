#include "source/RigInput.h"

#include "source/RigLive.h"
#include "source/RigReplay.h"

namespace scanloom
{
std::optional<SensorEvent> RigInput::next()
{
  while (!ended())
    if (std::optional<SensorEvent> event = next(1s)) return event;
  return std::nullopt;
}

std::unique_ptr<RigInput> openRig(const Rig& rig)
{
  if (rig.captures.empty()) return std::make_unique<RigLive>(rig);
  return std::make_unique<RigReplay>(rig);
}
}  // namespace scanloom
