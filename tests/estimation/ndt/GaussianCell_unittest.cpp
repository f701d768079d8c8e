#include "estimation/ndt/internal/GaussianCell.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace scanloom::gaussian_cell_unittest
{
namespace
{
Moments momentsOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& corner)
{
  Moments m;
  for (const Eigen::Vector3d& p : points)
  {
    const Eigen::Vector3d q = (p - corner) / Moments::kQuantum;
    m.add(std::llround(q.x()), std::llround(q.y()), std::llround(q.z()));
  }
  return m;
}

GaussianCell gaussianOf(const Moments& moments, const Eigen::Vector3d& corner, double edge, double min_deviation)
{
  const CellPoints points{moments, corner};
  return gaussiansOf(&points, 1, edge, min_deviation)[0];
}

std::vector<Eigen::Vector3d> randomPoints(int n, const Eigen::Vector3d& deviations)
{
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < n; ++i)
    points.push_back(Eigen::Vector3d(1000.4, -3.2, 7.5) +
                     deviations.cwiseProduct(Eigen::Vector3d(normal(random), normal(random), normal(random))));
  return points;
}

TEST(GaussianCell, ofOnePointIsItWith8cmToAllSides)
{
  const Eigen::Vector3d point(3.25, 4.5, 5.75);
  const GaussianCell cell = gaussianOf(momentsOf({point}, {3, 4, 5}), {3, 4, 5}, 1, 0.03);

  EXPECT_EQ(cell.points, 1u);
  EXPECT_LT((cell.mean - point).norm(), 1e-9);
  EXPECT_LT((cell.covariance - 0.0064 * Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(GaussianCell, ofTwoPointsLiesHalfWayBetweenTheirsAndThatOfOne)
{
  const GaussianCell cell = gaussianOf(momentsOf({{3.25, 4.5, 5.5}, {3.75, 4.5, 5.5}}, {3, 4, 5}), {3, 4, 5}, 1, 0.03);

  const Eigen::Vector3d variances(0.125, 0, 0);  // 0.25^2 + 0.25^2
  const Eigen::Matrix3d expected = (variances + Eigen::Vector3d::Constant(0.0064)).asDiagonal();
  EXPECT_LT((cell.covariance - expected / 2).norm(), 1e-9);
}

TEST(GaussianCell, hasTheSampleMeanAndCovarianceFarFromTheOrigin)
{
  const auto points = randomPoints(50, {0.3, 0.2, 0.1});
  Eigen::MatrixXd matrix(3, 50);
  for (int i = 0; i < 50; ++i) matrix.col(i) = points[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd centred = matrix.colwise() - matrix.rowwise().mean();

  const Eigen::Vector3d corner(1000, -4, 7);
  const GaussianCell cell = gaussianOf(momentsOf(points, corner), corner, 1, 0.01);

  EXPECT_LT((cell.mean - matrix.rowwise().mean()).norm(), 1e-5);
  EXPECT_LT((cell.covariance - centred * centred.transpose() / 49).norm(), 1e-5);
  EXPECT_EQ(cell.points, 50u);
}

TEST(GaussianCell, raisesOnlyTheEigenvaluesBelowTheFloor)
{
  const auto stem = randomPoints(200, {0.001, 0.2, 0.002});
  const GaussianCell cell = gaussianOf(momentsOf(stem, {1000, -4, 7}), {1000, -4, 7}, 1, 0.03);

  const Eigen::Vector3d deviations =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cell.covariance).eigenvalues().cwiseSqrt();
  EXPECT_NEAR(deviations[0], 0.03, 1e-6);
  EXPECT_NEAR(deviations[1], 0.03, 1e-6);
  EXPECT_NEAR(deviations[2], 0.2, 0.02);
}

TEST(Moments, takeOutWhatWasAddedWithoutATrace)
{
  const Moments a = momentsOf(randomPoints(30, {0.3, 0.2, 0.1}), {999, -5, 6});
  const Moments b = momentsOf(randomPoints(77, {0.1, 0.1, 0.4}), {999, -5, 6});
  Moments both = a;
  both += b;
  both -= b;

  EXPECT_EQ(both.n, a.n);
  EXPECT_EQ(both.x, a.x);
  EXPECT_EQ(both.xz, a.xz);
  EXPECT_EQ(both.zz, a.zz);
}
}  // namespace
}  // namespace scanloom::gaussian_cell_unittest
