/** Decompositions of small matrices, compiled in one place because each takes the compiler seconds. */
#pragma once
#include "base/core/Rigid.h"

#include <optional>

namespace scanloom
{
/** J' m J. */
Matrix6d congruent(const Matrix6d& m, const Matrix6d& j);

Matrix6d inverse(const Matrix6d&);

/** The x with a x = b. */
Matrix6d solve(const Matrix6d& a, const Matrix6d& b);

/** Of a symmetric matrix; finite, too. */
bool isPositiveDefinite(const Eigen::Ref<const Eigen::MatrixXd>&);

/** None if `a` is not positive definite. */
std::optional<Vector6d> solvePositive(const Matrix6d& a, const Vector6d& b);

/** Of a positive definite matrix. */
Matrix6d inverseOfPositive(const Matrix6d&);

/** The x with a x = b, a symmetric and of any size. */
Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/** Of an estimate with a further error of this covariance: inverse(inverse(information) + error), also if singular. */
Matrix6d informationWithError(const Matrix6d& information, const Matrix6d& error);

/** Eigenvalues of a symmetric matrix in ascending order, and their unit vectors as columns. */
template <int Size>
struct Eigensystem
{
  Eigen::Matrix<double, Size, 1> values;
  Eigen::Matrix<double, Size, Size> vectors;
};
using Eigensystem3 = Eigensystem<3>;
using Eigensystem6 = Eigensystem<6>;
using Eigensystem7 = Eigensystem<7>;
Eigensystem3 eigensystem3(const Eigen::Matrix3d& symmetric);
Eigensystem6 eigensystem(const Matrix6d& symmetric);
Eigensystem7 eigensystem7(const Eigen::Matrix<double, 7, 7>& symmetric);

/** Of a x = value b x, b positive definite. */
Eigensystem6 eigensystem(const Matrix6d& a, const Matrix6d& b);

/** The rotation R with the largest trace of R' m (Umeyama 1991, eq. (40) and (43)). */
struct LargestTrace
{
  Eigen::Matrix3d rotation;
  Eigen::Vector3d singular_values;  // of m, descending; the last is negative if a reflection would fit better
};
LargestTrace rotationOfLargestTrace(const Eigen::Matrix3d& m);
}  // namespace scanloom
