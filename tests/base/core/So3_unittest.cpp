#include "base/core/So3.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

namespace scanloom::so3_unittest
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
const std::vector<Vector3d> kRotations{{0, 0, 0},        {1e-9, -2e-9, 1e-9}, {9e-5, 1e-5, -3e-5}, {2e-4, 0, 1e-4},
                                       {0.3, -0.2, 0.5}, {1.5, 2.0, -1.0},    {0, 0, 3.14}};
}

TEST(So3, expAgreesWithTheMatrixExponential)
{
  for (const Vector3d& v : kRotations)
    EXPECT_LT((expSo3(v).toRotationMatrix() - Matrix3d(skew(v).exp())).norm(), 1e-13) << v.transpose();
}

TEST(So3, logIsTheInverseOfExp)
{
  for (const Vector3d& v : kRotations) EXPECT_LT((logSo3(expSo3(v)) - v).norm(), 1e-12) << v.transpose();
}

TEST(So3, logTakesTheShortWayForBothSignsOfAQuaternion)
{
  Eigen::Quaterniond q = expSo3({0.3, -0.2, 0.5});
  q.coeffs() *= -1;
  EXPECT_LT((logSo3(q) - Vector3d(0.3, -0.2, 0.5)).norm(), 1e-13);
}

TEST(So3, rotationBetweenDirectionsIsEigens)
{
  for (const Vector3d& v : kRotations)
  {
    const Vector3d from(0.2, -3, 1), to = 2 * (expSo3(v) * from);
    EXPECT_EQ(rotationBetween(from, to).coeffs(), Eigen::Quaterniond::FromTwoVectors(from, to).coeffs())
        << v.transpose();
  }
}

TEST(So3, rotationBetweenOppositeDirectionsIsHalfATurn)
{
  for (const Vector3d& from : {Vector3d(0.2, -3, 1), Vector3d(1, 0, 0), Vector3d(0, 0, -2)})
  {
    const Eigen::Quaterniond turn = rotationBetween(from, -2 * from);
    EXPECT_LT((turn * from + from).norm(), 1e-13 * from.norm());
    EXPECT_LT(std::abs(turn.norm() - 1), 1e-13);
  }
}

TEST(So3, rightJacobianIsTheDerivativeOfExp)
{
  for (const Vector3d& v : kRotations)
  {
    Matrix3d numeric;
    const double h = 1e-5;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3d dv = h * Vector3d::Unit(k);
      const auto change = [&](double sign) { return logSo3(expSo3(v).conjugate() * expSo3(v + sign * dv)); };
      numeric.col(k) = (change(1) - change(-1)) / (2 * h);
    }
    EXPECT_LT((rightJacobianSo3(v) - numeric).norm(), 1e-9) << v.transpose();
    EXPECT_LT((rightJacobianSo3(v) * rightJacobianInverseSo3(v) - Matrix3d::Identity()).norm(), 1e-11) << v.transpose();
  }
}
}  // namespace scanloom::so3_unittest
