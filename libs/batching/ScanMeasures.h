/** What the points of a scan have in common in time and place: to compare ways of batching. */
#pragma once
#include "batching/Scan.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/** Stamp of the newest column minus that of the oldest; 0 for a scan without columns. */
Duration spanOf(const Scan&);

/**
 * How far these points of the cloud lie apart along a unit vector, m. For the points of one object that moves along it,
 * what its own depth leaves of this is smear: the paper's 28 cm (section 1.1). 0 for less than two points.
 */
double extentAlong(const Eigen::Vector3d& direction, const PointCloud&, const std::vector<std::size_t>& points);
}  // namespace scanloom
