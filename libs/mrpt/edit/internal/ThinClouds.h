#pragma once
#include "mrpt/edit/RawlogEdit.h"

namespace scanloom
{
/**
 * Keeps the first point in each cube with this edge (m) of the body frame, for each cloud on its own and for clouds of
 * any class. Throws std::invalid_argument unless edge > 0.
 */
RawlogOperation thinClouds(double edge);
}  // namespace scanloom
