/** Decompositions of 6x6 matrices, compiled in one place because each takes the compiler seconds. */
#pragma once
#include "core/Rigid.h"

#include <optional>

namespace scanloom
{
/** J' m J. */
Matrix6d congruent(const Matrix6d& m, const Matrix6d& j);

Matrix6d inverse(const Matrix6d&);

/** The x with a x = b. */
Matrix6d solve(const Matrix6d& a, const Matrix6d& b);

/** Finite, too. */
bool isPositiveDefinite(const Matrix6d&);

/** None if `a` is not positive definite. */
std::optional<Vector6d> solvePositive(const Matrix6d& a, const Vector6d& b);

/** Of a positive definite matrix. */
Matrix6d inverseOfPositive(const Matrix6d&);

/** Of an estimate with a further error of this covariance: inverse(inverse(information) + error), also if singular. */
Matrix6d informationWithError(const Matrix6d& information, const Matrix6d& error);

/** Eigenvalues in ascending order, and their vectors as columns. */
struct Eigensystem6
{
  Vector6d values;
  Matrix6d vectors;
};
Eigensystem6 eigensystem(const Matrix6d& symmetric);

/** Of a x = value b x, b positive definite. */
Eigensystem6 eigensystem(const Matrix6d& a, const Matrix6d& b);
}  // namespace scanloom
