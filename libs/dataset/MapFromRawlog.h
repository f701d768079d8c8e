/** Maps of a rawlog whose trajectory is known already. */
#pragma once
#include "core/Keyframe.h"
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"
#include "output/OctoMapExport.h"
#include "output/SimpleMapFile.h"
#include "output/Trajectory.h"

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
 * Whole scans, deskewed, one each time the body has moved on, to `add`; `close` at the end of input, which throws
 * std::runtime_error before if there was none. Passes nothing on.
 */
RawlogOperation overKeyframes(const KeyframeOptions&, const RecordingHeader&, std::function<void(Keyframe)> add,
                              std::function<void()> close);

/** As .simplemap (SimpleMapBuilder): memory grows with the number of keyframes. Passes nothing on. */
RawlogOperation toSimpleMap(const std::filesystem::path&, const KeyframeOptions&, const RecordingHeader&);

/** As .bt beside .ot (OctoMapBuilder), points thinned to one a voxel and keyframe: memory grows with the map. */
RawlogOperation toOctoMap(const std::filesystem::path& binary, const OctoMapOptions&, const KeyframeOptions&,
                          const RecordingHeader&);
}  // namespace scanloom
