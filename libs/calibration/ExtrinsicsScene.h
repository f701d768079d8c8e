/** What two lidars saw at one place, to look at: before the calibration and after it. */
#pragma once
#include "calibration/internal/Stations.h"

#include <vector>

namespace scanloom
{
/** Points in the body's frame at one instant (m). */
struct ExtrinsicsScene
{
  std::vector<Eigen::Vector3f> reference;      // by the reference lidar
  std::vector<Eigen::Vector3f> before, after;  // by the other one, as it was said to be mounted and as it is
};

/** Of at most six stations, evenly chosen. */
std::vector<ExtrinsicsScene> extrinsicsScenes(const std::vector<Station>&, const Extrinsics& before,
                                              const Extrinsics& after, const Trajectory&);
}  // namespace scanloom
