/** What a least-squares problem tells of its last seven unknowns, the extrinsics. */
#pragma once
#include "calibration/internal/ExtrinsicsEquations.h"

#include <ceres/crs_matrix.h>

#include <vector>

namespace scanloom
{
struct ExtrinsicsInformation
{
  Matrix7d information = Matrix7d::Zero();
  std::vector<Vector7d> gradients;  // by pose
};

/**
 * In metres (extrinsicsStepOfMetres). All other unknowns take their best value (Schur complement), also in what each
 * pose's rows pull: so gradients of different poses may be compared.
 */
ExtrinsicsInformation informationOfLast7(const ceres::CRSMatrix& jacobian, const std::vector<double>& residuals,
                                         const std::vector<std::size_t>& pose_of_row, std::size_t poses);
}  // namespace scanloom
