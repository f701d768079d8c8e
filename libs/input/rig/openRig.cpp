#include "input/rig/openRig.h"

#include "input/rig/internal/RigLive.h"
#include "input/rig/internal/RigReplay.h"
#include "input/rig/internal/RigTopics.h"

namespace scanloom
{
std::unique_ptr<SensorInput> openRig(const Rig& rig)
{
  if (rig.live.ros2) return std::make_unique<RigTopics>(rig);
  if (rig.captures.empty()) return std::make_unique<RigLive>(rig);
  return std::make_unique<RigReplay>(rig);
}
}  // namespace scanloom
