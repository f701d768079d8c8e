/** Central differences for every analytic Jacobian of the project. */
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <functional>

namespace scanloom
{
/** f maps a step in the tangent space of its argument (length analytic.cols()) to a vector (length analytic.rows()). */
inline Eigen::MatrixXd numericJacobian(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                       Eigen::Index columns, double h = 1e-6)
{
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(columns);
  Eigen::MatrixXd jacobian(f(zero).size(), columns);
  for (Eigen::Index k = 0; k < columns; ++k)
  {
    Eigen::VectorXd step = zero;
    step[k] = h;
    jacobian.col(k) = (f(step) - f(-step)) / (2 * h);
  }
  return jacobian;
}

/** Fails unless `analytic` equals the central differences of f to `tolerance`, relative to its largest element. */
inline void checkJacobian(const Eigen::MatrixXd& analytic,
                          const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f, double tolerance = 1e-6,
                          double h = 1e-6)
{
  const Eigen::MatrixXd numeric = numericJacobian(f, analytic.cols(), h);
  ASSERT_EQ(analytic.rows(), numeric.rows());
  const double scale = std::max(1e-12, analytic.cwiseAbs().maxCoeff());
  EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff() / scale, tolerance) << "analytic:\n"
                                                                           << analytic << "\ncentral differences:\n"
                                                                           << numeric;
}
}  // namespace scanloom
