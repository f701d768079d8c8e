#pragma once
#include "core/PointCloud.h"
#include "core/Rigid.h"
#include "core/Time.h"

namespace scanloom
{
/** A deskewed scan with the pose that the map gives it: what all maps are made of. */
struct Keyframe
{
  Timestamp stamp;  // the instant of map_T_body; the points' t counts from here
  Rigid map_T_body;
  PointCloud points;  // in the body frame at `stamp`
};
}  // namespace scanloom
