/** What a localisation run writes. */
#pragma once
#include "base/core/Field.h"

#include <string>

namespace scanloom
{
struct OutputOptions
{
  bool maps = true;
  std::string dense_map;
  double dense_voxel = 0.05;
  std::string keyframe_class = "CGenericPointsMap";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.maps, Field{"maps", "", "false: write trajectories and summary only, no keyframes, clouds or picture"});
    visit(o.keyframe_class,
          Field{"keyframe_class", "",
                "of the clouds in keyframes.simplemap: CGenericPointsMap (MRPT from 2.15.3 on; older ones with the "
                "plugin) or CPointsMapXYZI (MRPT 2 without the plugin)"});
    visit(o.dense_map,
          Field{"dense_map", "",
                "las, laz, pcd or ply: write dense_map.las, ... with the points of all processed scans, not "
                "only of keyframes; empty: none"});
    visit(o.dense_voxel, Field{"dense_voxel", "m",
                               "edge of cubes of which the dense map has one point each, the first seen; 0: all points",
                               between(0, 100)});
  }
};
}  // namespace scanloom
