#include "estimation/ndt/D2dCost.h"

#include "estimation/ndt/NormalEquations.h"
#include "estimation/ndt/RayWorld.h"
#include "support/checkJacobian.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace scanloom::d2d_cost_unittest
{
namespace
{
std::vector<CellPair> randomPairs(int n, const Rigid& target_T_source)
{
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto vector = [&](double scale)
  { return Eigen::Vector3d(scale * Eigen::Vector3d(normal(random), normal(random), normal(random))); };
  const auto covariance = [&]
  {
    Eigen::Matrix3d root;
    root << vector(0.3), vector(0.3), vector(0.3);
    return Eigen::Matrix3d(root * root.transpose() + 0.01 * Eigen::Matrix3d::Identity());
  };
  std::vector<CellPair> pairs;
  for (int i = 0; i < n; ++i)
  {
    const GaussianCell source{vector(5), covariance(), 10};
    pairs.push_back({{target_T_source * source.mean + vector(0.4), covariance(), 10}, source});
  }
  return pairs;
}

Rigid somePose() { return Rigid::fromXyzYawPitchRoll(0.7, -1.2, 0.3, 1.9, -0.4, 0.2); }

TEST(D2dCost, hasTheGradientOfItsValue)
{
  const auto pairs = randomPairs(40, somePose());
  const D2dCost cost = d2dCost(pairs, somePose(), 0.05);

  checkJacobian(cost.gradient.transpose(), [&](const Eigen::VectorXd& step)
                { return Eigen::VectorXd::Constant(1, d2dCost(pairs, boxPlus(somePose(), step), 0.05).value); });
}

TEST(D2dCost, hasTheHessianOfItsGradient)
{
  const auto pairs = randomPairs(40, somePose());
  const D2dCost cost = d2dCost(pairs, somePose(), 0.05);

  // The gradient at a stepped pose is in the tangent there: brought back to the chart at somePose().
  checkJacobian(cost.hessian,
                [&](const Eigen::VectorXd& step)
                {
                  const Vector6d there = d2dCost(pairs, boxPlus(somePose(), step), 0.05).gradient;
                  Eigen::VectorXd here(6);
                  here << expSo3(step.tail<3>()) * Eigen::Vector3d(there.head<3>()),
                      rightJacobianSo3(step.tail<3>()).transpose() * there.tail<3>();
                  return here;
                });
}

/** The target with M of doc/registration.md in its covariance, held as at the pose; d2 = 0.05. */
GaussianCell withMixture(GaussianCell target, const GaussianCell& source, const Rigid& target_T_source)
{
  const Eigen::Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  const double a = (rotation * source.covariance * rotation.transpose())(2, 2), b = target.covariance(2, 2);
  target.covariance(2, 2) += 4 * 0.05 * (a - b) * (a - b) / (a + b);
  return target;
}

TEST(NormalEquations, agreeWithTheExactCost)
{
  const Rigid pose = Rigid::fromXyzYawPitchRoll(0.1, 0.05, 0.02, 0.01, 0, 0);
  const NdtMap target(scanFrom(forest(3), Rigid::identity(), 1), {}),
      source(scanFrom(forest(3), pose, 2), with(&NdtOptions::cell_size, 2.5));
  CellCorrespondences correspondences(target, source, 27);
  correspondences.moveTo(pose);
  std::vector<CellPair> pairs;
  for (std::size_t i = 0; i < source.cells().size(); ++i)
    for (const auto j : correspondences.of(i))
      pairs.push_back({withMixture(target.cells()[j], source.cells()[i], pose), source.cells()[i]});

  const NormalEquations fast = normalEquations(correspondences, pose, 0.05);
  const D2dCost exact = d2dCost(pairs, pose, 0.05);

  EXPECT_NEAR(fast.value / exact.value, 1, 1e-12);
  EXPECT_LT((fast.gradient - exact.gradient).head<3>().norm(),
            1e-9 * exact.gradient.norm());  // B depends on no translation
  EXPECT_LT((fast.curvature - exact.hessian).norm(), 0.2 * exact.hessian.norm());
  EXPECT_GE(fast.curvature.eigenvalues().real().minCoeff(), 0);
}
}  // namespace
}  // namespace scanloom::d2d_cost_unittest
