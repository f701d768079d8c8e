#pragma once
#include "dataset/RawlogEdit.h"

namespace scanloom
{
/** The first point of each cube with this edge (m) of the body frame, cloud by cloud, of clouds of any class. Throws
 * std::invalid_argument unless edge > 0. */
RawlogOperation thinClouds(double edge);
}  // namespace scanloom
