/** PCD, the cloud format of the Point Cloud Library (its documentation: "The PCD (Point Cloud Data) file format"). */
#pragma once
#include "base/core/Bytes.h"
#include "base/formats/internal/CloudPoints.h"

namespace scanloom
{
/**
 * A file in memory: ascii, binary or binary_compressed, with x, y and z (float or double) among its fields, and perhaps
 * a time. Throws std::invalid_argument saying what is wrong.
 */
CloudPoints pcdPoints(Bytes file);
}  // namespace scanloom
