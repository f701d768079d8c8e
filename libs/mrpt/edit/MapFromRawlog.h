/** Maps of a rawlog whose trajectory is known. */
#pragma once
#include "base/core/StampedPose.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/maps/OctoMapExport.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace scanloom
{
struct KeyframeOptions
{
  Trajectory trajectory;
  double distance = 4;  // m of travel between keyframes
};

/**
 * Writes maps, one for each path, in the format of its ending (requireMapEndings). A scan becomes a keyframe, deskewed,
 * each time the body has travelled `distance`; `onKeyframe` is called after each. Throws std::runtime_error at the end
 * of input if there was none.
 */
RawlogOperation toMaps(
    const std::vector<std::filesystem::path>&, const OctoMapOptions&, const KeyframeOptions&, const RecordingHeader&,
    std::function<void()> onKeyframe = [] {});
}  // namespace scanloom
