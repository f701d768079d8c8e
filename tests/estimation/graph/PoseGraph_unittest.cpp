#include "estimation/graph/PoseGraph.h"

#include "estimation/graph/internal/DriftingMotionFactor.h"
#include "estimation/graph/internal/PositionFactor.h"
#include "estimation/graph/internal/UpFactor.h"
#include "support/checkJacobian.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <cmath>

namespace scanloom::pose_graph_unittest
{
namespace
{
using testing::HasSubstr;

constexpr double kMetres = 0.02, kRadians = 0.002;  // of the edges below

Matrix6d edgeCovariance()
{
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kMetres), Eigen::Vector3d::Constant(kRadians);
  return sigma.cwiseAbs2().asDiagonal();
}

/** Corners of a regular polygon with edges of 4 m, headed along the edges, on a slope so that no axis is special. */
std::vector<Rigid> polygon(std::size_t corners)
{
  std::vector<Rigid> poses{Rigid::fromXyzYawPitchRoll(10, -5, 2, 0.4, 0.1, -0.05)};
  const Rigid step = Rigid::fromXyzYawPitchRoll(4, 0, 0, 2 * M_PI / static_cast<double>(corners), 0, 0);
  while (poses.size() < corners) poses.push_back(poses.back() * step);
  return poses;
}

RelativePose edge(const std::vector<Rigid>& poses, std::size_t from, std::size_t to)
{
  return {from, to, poses[from].inverse() * poses[to], edgeCovariance()};
}

/** The true poses joined by edges that are off by `error`, and led astray by them from the first one on. */
PoseGraph drifted(const std::vector<Rigid>& truth, const Vector6d& error)
{
  PoseGraph graph;
  graph.map_T_body = {truth.front()};
  graph.scale_sigma = 1e-6;
  graph.fixed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const Eigen::Vector3d up = truth[i].rotation.conjugate() * Eigen::Vector3d::UnitZ();
    graph.ups.push_back({i, up, 1e-3});
    if (i + 1 == truth.size()) break;
    OdometryPose next{edge(truth, i, i + 1), 0, up};
    next.from_T_to = boxPlus(next.from_T_to, error);
    graph.odometry.push_back(next);
    graph.map_T_body.push_back(graph.map_T_body.back() * next.from_T_to);
  }
  return graph;
}

Vector6d turningLeft(double radians)
{
  Vector6d error = Vector6d::Zero();
  error[5] = radians;
  return error;
}

double farthest(const std::vector<Rigid>& poses, const std::vector<Rigid>& truth)
{
  double most = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    most = std::max(most, (poses[i].translation - truth[i].translation).norm());
  return most;
}

const Rigid kPose = Rigid::fromXyzYawPitchRoll(1, -2, 3, 0.4, 0.3, -0.2);
const Rigid kOther = Rigid::fromXyzYawPitchRoll(4, -1, 3.5, 0.9, 0.1, 0.1);

/** By steps of the poses, and of what else a factor depends on. */
void checkFactor(const ceres::CostFunction& factor, const std::vector<Rigid>& poses, const Eigen::VectorXd& more = {})
{
  const auto evaluate = [&](const Eigen::VectorXd& step, std::vector<Eigen::MatrixXd>* jacobians)
  {
    std::vector<PoseBlock> blocks;
    std::vector<const double*> parameters;
    for (std::size_t i = 0; i < poses.size(); ++i)
      blocks.push_back(blockOf(boxPlus(poses[i], step.segment<6>(6 * static_cast<Eigen::Index>(i)))));
    for (const PoseBlock& block : blocks) parameters.push_back(block.data());
    const Eigen::VectorXd rest = more + step.tail(more.size());
    if (rest.size() > 0) parameters.push_back(rest.data());
    Eigen::VectorXd residual(factor.num_residuals());
    std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> raw;
    for (const int size : factor.parameter_block_sizes()) raw.emplace_back(factor.num_residuals(), size);
    std::vector<double*> outputs;
    for (auto& jacobian : raw) outputs.push_back(jacobian.data());
    EXPECT_TRUE(factor.Evaluate(parameters.data(), residual.data(), outputs.data()));
    if (jacobians)
      for (std::size_t i = 0; i < raw.size(); ++i)
        jacobians->push_back(i < poses.size() ? Eigen::MatrixXd(raw[i] * PoseManifold::plusJacobian(poses[i]))
                                              : Eigen::MatrixXd(raw[i]));
    return residual;
  };
  std::vector<Eigen::MatrixXd> jacobians;
  const Eigen::Index size = 6 * static_cast<Eigen::Index>(poses.size()) + more.size();
  evaluate(Eigen::VectorXd::Zero(size), &jacobians);
  Eigen::MatrixXd analytic(factor.num_residuals(), size);
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& jacobian : jacobians)
  {
    analytic.middleCols(at, jacobian.cols()) = jacobian;
    at += jacobian.cols();
  }
  checkJacobian(analytic, [&](const Eigen::VectorXd& step) { return evaluate(step, nullptr); });
}
}  // namespace

TEST(PoseGraph, jacobiansOfItsFactorsAreCentralDifferences)
{
  checkFactor(UpFactor(Eigen::Vector3d(0.2, -0.1, 1).normalized(), 0.1), {kPose});
  Eigen::Matrix3d covariance;
  covariance << 2, 0.3, 0.1, 0.3, 1, -0.2, 0.1, -0.2, 3;
  checkFactor(PositionFactor({0.5, -1, 2}, {3, 4, 5}, covariance), {kPose});
  checkFactor(DriftingMotionFactor(kOther, Eigen::Vector3d(0.1, 0.2, 1).normalized(), Matrix6d::Identity()),
              {kPose, kOther}, Eigen::Vector2d(0.01, -0.02));
}

TEST(PoseGraph, aLoopClosesWhatTheOdometryHasLeftOpen)
{
  const std::vector<Rigid> truth = polygon(20);
  PoseGraph graph = drifted(truth, turningLeft(kRadians));
  ASSERT_GT(farthest(graph.map_T_body, truth), 0.5);
  graph.loops.push_back(edge(truth, 0, 19));
  graph.loops.push_back(edge(truth, 1, 18));
  const SolvedPoseGraph result = solved(graph);
  EXPECT_LT(farthest(result.map_T_body, truth), 0.1);
  EXPECT_THAT(result.loops_used, testing::Each(true));
}

TEST(PoseGraph, aFalseLoopMovesNothingAndIsNamed)
{
  const std::vector<Rigid> truth = polygon(20);
  PoseGraph graph = drifted(truth, turningLeft(kRadians));
  for (const std::size_t i : {0, 1, 2}) graph.loops.push_back(edge(truth, i, 19 - i));
  const std::vector<Rigid> without = solved(graph).map_T_body;
  graph.loops.push_back(edge(truth, 4, 14));
  graph.loops.back().from_T_to.translation += Eigen::Vector3d(3, -2, 0);
  const SolvedPoseGraph result = solved(graph);
  EXPECT_THAT(result.loops_used, testing::ElementsAre(true, true, true, false));
  EXPECT_GT(result.loop_distances.back(), 10);
  EXPECT_LT(farthest(result.map_T_body, without), 1e-3);
}

TEST(PoseGraph, covariancesOfAChainAreTheSumsOfItsEdges)
{
  // Along a line, heading and gravity hold the turns: errors along the line add up, edge by edge.
  std::vector<Rigid> truth;
  for (int i = 0; i < 5; ++i) truth.push_back(Rigid::fromXyzYawPitchRoll(4 * i, 0, 0, 0, 0, 0));
  const std::vector<Matrix6d> covariances = covariancesOf(drifted(truth, Vector6d::Zero()));
  for (std::size_t i = 1; i < truth.size(); ++i)
    EXPECT_NEAR(covariances[i](0, 0), static_cast<double>(i) * kMetres * kMetres, 1e-6);
  double across = 0;  // each edge turns what follows
  for (int i = 1; i <= 4; ++i) across += kMetres * kMetres + std::pow(4.0 * (4 - i) * kRadians, 2);
  EXPECT_NEAR(covariances[4](1, 1), across, 0.02 * across);
}

TEST(PoseGraph, anOdometryThatIsTooShortIsMendedByPositions)
{
  const std::vector<Rigid> truth = polygon(20);
  Vector6d shrinking = Vector6d::Zero();
  shrinking[0] = -0.02;  // of 4 m
  PoseGraph graph = drifted(truth, shrinking);
  graph.scale_sigma = 0.01;
  graph.fixed.reset();
  const Eigen::Vector3d lever(0.5, -1, 2);
  for (const std::size_t i : {0, 3, 6, 9})
    graph.positions.push_back({i, lever, truth[i] * lever, 1e-6 * Eigen::Matrix3d::Identity()});
  const SolvedPoseGraph result = solved(graph);
  EXPECT_LT((result.map_T_body[19].translation - truth[19].translation).norm(), 0.05)
      << "the scale is known from the first half";
}

TEST(PoseGraph, aWrongPositionMovesNothingAndIsNamed)
{
  const std::vector<Rigid> truth = polygon(12);
  PoseGraph graph = drifted(truth, turningLeft(0.5 * kRadians));
  graph.fixed.reset();
  for (std::size_t i = 0; i < truth.size(); ++i)
    graph.positions.push_back({i, {0, 0, 0}, truth[i].translation, 1e-4 * Eigen::Matrix3d::Identity()});
  graph.positions[5].map_p_point += Eigen::Vector3d(0, 2, 0);
  const SolvedPoseGraph result = solved(graph);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_EQ(result.positions_used[i], i != 5) << i;
  EXPECT_LT(farthest(result.map_T_body, truth), 0.02);
}

TEST(PoseGraph, saysWhatIsWrongWithIt)
{
  const std::vector<Rigid> truth = polygon(4);
  PoseGraph graph = drifted(truth, Vector6d::Zero());
  graph.loops.push_back(edge(truth, 0, 1));
  graph.loops.back().to = 7;
  EXPECT_THAT(messageOf([&] { solved(graph); }), HasSubstr("from 0 to 7 among 4 poses"));
  graph.loops.back() = edge(truth, 0, 3);
  graph.loops.back().covariance(2, 2) = 0;
  EXPECT_THAT(messageOf([&] { solved(graph); }), HasSubstr("not positive definite"));
  graph.loops.clear();
  graph.fixed.reset();
  EXPECT_THAT(messageOf([&] { solved(graph); }), HasSubstr("nothing holds"));
}
}  // namespace scanloom::pose_graph_unittest
