/** What became of each lidar's points when a run cropped its scans. */
#pragma once
#include "estimation/preprocessing/Crop.h"
#include "input/rig/RecordingHeader.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
/** As `<lidar>.points_<kept, machine, ...>`; the counts are by sensor id. */
void addCounts(const std::vector<CropCounts>&, const std::vector<RecordedLidar>&,
               std::map<std::string, std::uint64_t>& counts);

/**
 * A warning for each lidar that keeps less than a tenth of its points: the box is too large, or it is given in another
 * frame.
 */
std::vector<std::string> cropWarnings(const std::vector<CropCounts>&, const std::vector<RecordedLidar>&);
}  // namespace scanloom
