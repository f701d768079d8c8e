/** Removes the motion distortion of a scan, column by column. */
#pragma once
#include "base/core/Rigid.h"
#include "input/batching/Scan.h"

#include <vector>

namespace scanloom
{
/**
 * The scan's points as they would have been seen from the body at one instant. `reference_T_column` has, per column of
 * the scan, the pose of the body at the column's stamp in the body frame of that instant.
 * Throws std::invalid_argument unless there is one pose per column and the columns cover the points one after the
 * other.
 */
PointCloud deskew(Scan scan, const std::vector<Rigid>& reference_T_column);
}  // namespace scanloom
