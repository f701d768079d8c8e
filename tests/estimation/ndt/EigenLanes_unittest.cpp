#include "estimation/ndt/internal/EigenLanes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstring>
#include <random>

namespace scanloom::eigen_lanes_unittest
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Of flat, long and round clouds of points of all sizes, turned anyhow; the last are diagonal, and zero. */
std::vector<Matrix3d> covariances()
{
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Matrix3d> all;
  for (int i = 0; i < 1022; ++i)
  {
    Matrix3d root;
    for (double& entry : root.reshaped()) entry = normal(random);
    const Vector3d scales(std::pow(10.0, -(i % 4)), std::pow(10.0, -(i % 7)), std::pow(10.0, -(i % 3)));
    all.push_back(root * scales.cwiseAbs2().asDiagonal() * root.transpose());
  }
  all.push_back(Vector3d(0.3, 0.3, 1e-6).asDiagonal());
  all.emplace_back(Matrix3d::Zero());
  return all;
}

std::vector<EigenBlock> solved(const std::vector<Matrix3d>& matrices, Kernel kernel)
{
  std::vector<SymmetricBlock> blocks(matrices.size() / SymmetricBlock::kLanes);
  std::vector<EigenBlock> results(blocks.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    blocks[i / SymmetricBlock::kLanes].set(i % SymmetricBlock::kLanes, matrices[i]);
  for (std::size_t i = 0; i < blocks.size(); ++i) results[i] = eigensystemsOf(blocks[i], kernel);
  return results;
}

TEST(EigenLanes, areTheEigensystemsOfEigensSolver)
{
  const std::vector<Matrix3d> matrices = covariances();
  const std::vector<EigenBlock> results = solved(matrices, Kernel::Portable);
  for (std::size_t i = 0; i < matrices.size(); ++i)
  {
    const EigenBlock& block = results[i / SymmetricBlock::kLanes];
    const std::size_t lane = i % SymmetricBlock::kLanes;
    Vector3d values = block.valuesOf(lane);
    Matrix3d vectors;
    for (std::size_t k = 0; k < 3; ++k) vectors.col(static_cast<int>(k)) = block.vectorOf(k, lane);
    const double largest = std::max(1e-300, matrices[i].norm());
    EXPECT_LT((vectors * values.asDiagonal() * vectors.transpose() - matrices[i]).norm(), 1e-9 * largest) << i;
    EXPECT_LT((vectors.transpose() * vectors - Matrix3d::Identity()).norm(), 1e-9) << i;
    std::sort(values.begin(), values.end());
    const Vector3d expected = Eigen::SelfAdjointEigenSolver<Matrix3d>(matrices[i]).eigenvalues();
    EXPECT_LT((values - expected).norm(), 1e-9 * largest) << i;
  }
}

TEST(EigenLanes, haveTheSameBitsOnEveryKernel)
{
  const std::vector<Matrix3d> matrices = covariances();
  const std::vector<EigenBlock> portable = solved(matrices, Kernel::Portable);
  for (const Kernel kernel : runnableKernels())
  {
    const std::vector<EigenBlock> results = solved(matrices, kernel);
    EXPECT_EQ(std::memcmp(results.data(), portable.data(), portable.size() * sizeof(EigenBlock)), 0) << nameOf(kernel);
  }
}
}  // namespace
}  // namespace scanloom::eigen_lanes_unittest
