/** A map that an earlier drive has made, in which a later one is localised. */
#pragma once
#include "base/core/Keyframe.h"
#include "base/core/MountedLidar.h"
#include "estimation/ndt/NdtMap.h"
#include "estimation/slam/internal/SlamSettings.h"

#include <cstddef>
#include <vector>

namespace scanloom
{
/** Keyframes with the cells of their clouds, in the frame of the map. Never changed. */
class PriorMap
{
 public:
  struct Keyframe
  {
    Rigid map_T_body;
    Matrix6d covariance;  // of map_T_body, tangent of boxPlus; 0: not known
    BinnedPoints points;  // in the map frame, in cells of SlamSettings::map_cells
  };

  /**
   * `lidars`: those that the keyframes' sensor_ids name. Cells are corrected as the settings say, as those of the scans
   * will be. `covariances`: of the keyframes' poses, tangent of boxPlus; none: not known. Throws std::invalid_argument
   * without a keyframe.
   */
  PriorMap(const std::vector<scanloom::Keyframe>&, const std::vector<MountedLidar>& lidars, const SlamSettings&,
           const std::vector<Matrix6d>& covariances = {});

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  const std::vector<MountedLidar>& lidars() const { return lidars_; }

  /** Indices of the `count` keyframes that are nearest to a place and within `radius` (m) of it, in increasing order.
   */
  std::vector<std::size_t> around(const Eigen::Vector3d& place, std::size_t count, double radius) const;

  /** Of a body there by errors of the map itself, as its nearest keyframe has them: tangent of boxPlus. */
  Matrix6d covarianceAt(const Rigid& map_T_body) const;

  /** All keyframes in one map. */
  NdtMap whole() const;

 private:
  NdtOptions cells_;
  std::vector<MountedLidar> lidars_;
  std::vector<Keyframe> keyframes_;
};
}  // namespace scanloom
