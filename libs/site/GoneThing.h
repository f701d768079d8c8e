/** What earlier drives of a site have seen, and a later one has seen through: trees that were felled, cars that left.
 */
#pragma once
#include <Eigen/Core>

#include <cstddef>

namespace scanloom
{
struct GoneThing
{
  Eigen::Vector3d foot;          // m, in the frame of the site: below the middle of what is gone
  double height = 0, width = 0;  // m
  std::size_t gone_by = 0;       // the drive that saw it no more
};
}  // namespace scanloom
