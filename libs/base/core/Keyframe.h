#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

namespace scanloom
{
/** A deskewed scan with its pose in the map. Maps are made of keyframes. */
struct Keyframe
{
  Timestamp stamp;  // time of map_T_body; the points' t count from here
  Rigid map_T_body;
  PointCloud points;  // in the body frame at `stamp`
};
}  // namespace scanloom
