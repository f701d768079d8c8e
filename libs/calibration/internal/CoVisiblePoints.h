/** How many points two lidars should both see, and how many of these they see in the same place. */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"

namespace scanloom
{
struct CoVisiblePoints
{
  std::size_t common =
      0;  // points of A that B should see: not hidden from B, and its beams are at most 0.6 m apart there
  std::size_t near = 0;  // of those: points with one of B within 0.3 m
};

/** Both clouds in the body frame; A's is moved by `correction` first. */
CoVisiblePoints commonView(const PointCloud& a, const Rigid& correction, const PointCloud& b, const Rigid& body_T_b);
}  // namespace scanloom
