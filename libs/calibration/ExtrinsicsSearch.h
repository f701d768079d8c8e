/** A start for estimateExtrinsics() from a pose that may be far off. */
#pragma once
#include "calibration/RotationByImus.h"
#include "calibration/internal/Stations.h"

#include <optional>
#include <vector>

namespace scanloom
{
enum class PoseGiven
{
  Within20Degrees,  // and half a metre
  No,               // somewhere near the reference lidar
};

struct ExtrinsicsStart
{
  Extrinsics extrinsics;
  std::optional<Extrinsics> rival;  // the next best elsewhere, if it is nearly as good
};

/**
 * Roll, pitch and height such that both lidars see the ground in the same plane; then headings about the ground's
 * normal, as they are and refined with cells of 4 m and 2 m at eight stations. Around a given pose, which may be 20 deg
 * off, they are 10 deg apart. Without a pose they are 30 deg apart, all around; where the gyroscopes in the lidars tell
 * the rotation, it is taken, with five places 1.5 m apart. The one with most points where the reference saw something,
 * of those that the IMUs do not contradict.
 */
ExtrinsicsStart findStart(const std::vector<Station>&, const std::optional<Extrinsics>& given,
                          const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                          const Rigid& body_T_reference, const Trajectory&, const RotationByImus&);
}  // namespace scanloom
