#include "base/core/Decompositions.h"

#include <gtest/gtest.h>

namespace scanloom::decompositions_unittest
{
namespace
{
Matrix6d diagonal(double a, double b, double c, double d, double e, double f)
{
  Vector6d values;
  values << a, b, c, d, e, f;
  return values.asDiagonal();
}
}  // namespace

TEST(InformationWithError, addsVariances)
{
  const Matrix6d information = diagonal(1 / 4.0, 1 / 9.0, 1, 1, 1, 1);
  const Matrix6d left = informationWithError(information, diagonal(1, 7, 0, 0, 0, 3));
  EXPECT_LT((left - diagonal(1 / 5.0, 1 / 16.0, 1, 1, 1, 1 / 4.0)).norm(), 1e-15);
}

TEST(InformationWithError, leavesOpenWhatWasOpen)
{
  Vector6d open;
  open << 1, 2, 3, 0.1, 0.2, 0.3;
  const Matrix6d information =
      Matrix6d::Identity() - open * open.transpose() / open.squaredNorm();  // no information along `open`
  const Matrix6d left = informationWithError(information, diagonal(1, 1, 1, 1, 1, 1));
  EXPECT_LT((left - information / 2).norm(), 1e-15);
  EXPECT_LT((left - left.transpose()).norm(), 1e-18);
}
}  // namespace scanloom::decompositions_unittest
