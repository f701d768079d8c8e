/** PLY, the Polygon File Format (G. Turk, Stanford, 1994). */
#pragma once
#include "base/core/Bytes.h"
#include "base/formats/internal/CloudPoints.h"

namespace scanloom
{
/**
 * A file in memory: binary of either endianness or ascii. Its first element must be `vertex` with scalar properties, x,
 * y and z among them, and perhaps a time; other properties are skipped. Throws std::invalid_argument that says what is
 * wrong.
 */
CloudPoints plyPoints(Bytes file);
}  // namespace scanloom
