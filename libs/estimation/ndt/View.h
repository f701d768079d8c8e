/** Points together with the lidar from which they were seen. */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"
#include "estimation/ndt/CellCorrections.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace scanloom
{
/** Rings of a spinning lidar, which sees nothing between two of them. */
struct Rings
{
  Eigen::Vector3d axis;  // unit vector about which the lidar spins, in the frame of the points
  double spacing;        // rad, from a ring to the next, as seen from the lidar
};

/** The points of one lidar, in one frame. */
struct View
{
  std::vector<Eigen::Vector3f> points;
  std::optional<Eigen::Vector3d> viewpoint;  // none: unknown
  std::optional<Rings> rings{};              // none: unknown, or a single ring; only with a viewpoint
  CellCorrections corrections{};             // only with a viewpoint
};

/** A view for each lidar, indexed by sensor_id as `cloud_T_lidar` is. Lidars without a pose share the last view. */
std::vector<View> viewsOf(const PointCloud&, const std::vector<Rigid>& cloud_T_lidar, const CellCorrections& = {});

/** The view in the target's frame. */
View movedBy(const Rigid& target_T_view, const View&);
std::vector<View> movedBy(const Rigid& target_T_views, const std::vector<View>&);
}  // namespace scanloom
