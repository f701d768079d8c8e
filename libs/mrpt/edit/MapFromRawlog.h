/** Maps of a rawlog whose trajectory is known. */
#pragma once
#include "base/core/StampedPose.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/maps/MapFiles.h"

#include <functional>
#include <memory>

namespace scanloom
{
struct KeyframeOptions
{
  Trajectory trajectory;
  double distance = 4;  // m of travel between keyframes
};

/**
 * Fills and closes the maps. A scan becomes a keyframe, deskewed, each time the body has travelled `distance`;
 * `onKeyframe` is called after each. Throws std::runtime_error at the end of input if there was none.
 */
RawlogOperation toMaps(
    const std::shared_ptr<MapFiles>&, const KeyframeOptions&, const RecordingHeader&,
    std::function<void()> onKeyframe = [] {});
}  // namespace scanloom
