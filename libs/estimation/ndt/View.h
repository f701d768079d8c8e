/** Points together with the position from which they were seen. */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace scanloom
{
/** The points of one lidar, in one frame. */
struct View
{
  std::vector<Eigen::Vector3f> points;
  std::optional<Eigen::Vector3d> viewpoint;  // none: unknown
};

/** By sensor_id. Lidars without a viewpoint share the last view. */
std::vector<View> viewsOf(const PointCloud&, const std::vector<Eigen::Vector3d>& viewpoints);

/** In the target's frame. */
View movedBy(const Rigid& target_T_view, const View&);
}  // namespace scanloom
