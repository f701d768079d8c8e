/** PCD, the cloud format of the Point Cloud Library (its documentation: "The PCD (Point Cloud Data) file format"). */
#pragma once
#include "core/Bytes.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/**
 * x, y and z (float or double, among any other fields) of a file in memory: ascii, binary or binary_compressed. Throws
 * std::invalid_argument saying what is wrong.
 */
std::vector<Eigen::Vector3f> pcdPositions(Bytes file);
}  // namespace scanloom
