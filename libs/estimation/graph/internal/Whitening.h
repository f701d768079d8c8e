/** Square roots S with S'S = information: S times a residual is a residual in standard deviations. */
#pragma once
#include "estimation/imu/Preintegration.h"

namespace scanloom
{
/** The whitening of a symmetric information matrix that may be singular; eigenvalues below zero by rounding count as
 * zero. */
Matrix6d rootOfInformation(const Matrix6d&);

/** That of the inverse of a positive definite covariance. */
Eigen::Matrix3d rootOfInverse(const Eigen::Matrix3d& covariance);
Matrix9d rootOfInverse(const Matrix9d& covariance);
Matrix15d rootOfInverse(const Matrix15d& covariance);
}  // namespace scanloom
