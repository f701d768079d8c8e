/** PLY, the Polygon File Format (G. Turk, Stanford, 1994). */
#pragma once
#include "core/Bytes.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/**
 * x, y and z of a file in memory: binary of either endianness or ascii. Its first element must be `vertex` with scalar
 * properties, x, y and z among them; other properties are skipped. Throws std::invalid_argument that says what is
 * wrong.
 */
std::vector<Eigen::Vector3f> plyPositions(Bytes file);
}  // namespace scanloom
