/** Where a cell's mean is, if points did not get fewer with the distance from the lidar. */
#pragma once
#include "estimation/ndt/CellCorrections.h"

namespace scanloom
{
/**
 * The shift k C u / 2 (m) of a cell's points: C their covariance, u the unit vector from the viewpoint to their mean.
 *
 * A lidar sees more of the near side of what fills a cell evenly, as leaves do. Rays spread, so points per volume fall
 * with 1 / r^2; and what they hit stops them, so points fall with exp(-mu r). Across one cell both are about a factor
 * exp(-k u'x), k = mu + 2 / r. Times this factor a normal distribution N(m, C) is N(m - k C u, C): its mean lies nearer
 * by k C u, which turns with the view. A map that was seen from farther back seems to come along, and a drive through
 * foliage is measured too short, by some tenths of a percent.
 *
 * Only a half, because a part of C is of branches and clumps with gaps between them, which a lidar sees from all sides:
 * where the whole is right, a cube of even leaves, the half leaves 4 cm of 8; where it is too much, in simulated
 * stands, paths come out too long and turn (doc/study/localisation.md).
 *
 * Surfaces stay in their plane: across it C is nearly zero. mu is that of young spruce and undergrowth, 0.6 per m.
 */
Eigen::Vector3d rangeDensityShift(const MeanAndCovariance&, const Sight&);
}  // namespace scanloom
