#include "estimation/graph/PoseGraph.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/internal/DriftingMotionFactor.h"
#include "estimation/graph/internal/PositionFactor.h"
#include "estimation/graph/internal/RelativePoseFactor.h"
#include "estimation/graph/internal/UpFactor.h"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Squared distances that 1 % of right measurements exceed: chi-squared of 6 and 3 degrees of freedom.
constexpr double kUsualLoop = 16.81, kUsualPosition = 11.34;
constexpr double kConvexityStep = 1.4;  // H. Yang et al., section IV: mu grows by it
constexpr int kMostRounds = 60;
constexpr double kFixedMetres = 1e-4, kFixedRadians = 1e-6;

/** Weights of graduated non-convexity with truncated least squares (H. Yang et al., eq. (14)). */
class Weights
{
 public:
  Weights(std::size_t count, double usual) : usual_(usual), weights_(count, 1.0) {}

  double at(std::size_t i) const { return weights_[i]; }

  /** The mu from which it begins, by the measurements' squared distances: infinite if none of them is unusual. */
  double firstMu(const std::vector<double>& squares) const
  {
    const double largest = squares.empty() ? 0 : *std::max_element(squares.begin(), squares.end());
    return largest <= usual_ ? std::numeric_limits<double>::infinity() : usual_ / (2 * largest - usual_);
  }

  void update(const std::vector<double>& squares, double mu)
  {
    for (std::size_t i = 0; i < weights_.size(); ++i)
    {
      const double inside = mu / (mu + 1) * usual_, outside = (mu + 1) / mu * usual_;
      weights_[i] = squares[i] <= inside    ? 1
                    : squares[i] >= outside ? 0
                                            : std::sqrt(usual_ * mu * (mu + 1) / squares[i]) - mu;
    }
  }

  bool areDecided() const
  {
    return std::all_of(weights_.begin(), weights_.end(), [](double w) { return w < 0.01 || w > 0.99; });
  }

  std::vector<bool> used() const
  {
    std::vector<bool> used;
    for (const double w : weights_) used.push_back(w > 0.5);
    return used;
  }

 private:
  double usual_;
  std::vector<double> weights_;
};

Matrix6d gaugeInformation(const Rigid& map_T_body)
{
  const Eigen::Vector3d up = upInBody(map_T_body);
  Matrix6d information = Matrix6d::Zero();
  information.topLeftCorner<3, 3>().diagonal().setConstant(1 / (kFixedMetres * kFixedMetres));
  information.bottomRightCorner<3, 3>() = up * up.transpose() / (kFixedRadians * kFixedRadians);
  return information;
}

void require(bool met, const std::string& problem)
{
  if (!met) throw std::invalid_argument("pose graph: " + problem);
}

void requireSound(const PoseGraph& graph)
{
  const std::size_t count = graph.map_T_body.size();
  const auto requireEdge = [&](const RelativePose& edge)
  {
    require(edge.from < count && edge.to < count && edge.from != edge.to,
            fmt::format("an edge from {} to {} among {} poses", edge.from, edge.to, count));
    require(isPositiveDefinite(edge.covariance),
            fmt::format("the covariance of the edge from {} to {} is not positive definite", edge.from, edge.to));
  };
  for (const OdometryPose& edge : graph.odometry) requireEdge(edge);
  for (const RelativePose& edge : graph.loops) requireEdge(edge);
  require(graph.odometry.empty() || graph.scale_sigma > 0, "scale_sigma must be above 0");
  for (const MeasuredUp& up : graph.ups) require(up.pose < count && up.sigma > 0, "an up without a pose or a sigma");
  for (const MeasuredPosition& at : graph.positions)
    require(at.pose < count && isPositiveDefinite(at.covariance) && at.share > 0,
            "a position without a pose, a covariance or a share");
  if (graph.fixed) require(*graph.fixed < count, "the fixed pose is none of them");
}

/** The graph as Ceres sees it. */
class Problem
{
 public:
  explicit Problem(const PoseGraph& graph)
    : graph_(graph),
      loop_weights_(graph.loops.size(), kUsualLoop),
      position_weights_(graph.positions.size(), kUsualPosition)
  {
    for (const Rigid& pose : graph.map_T_body) blocks_.push_back(blockOf(pose));
    for (const OdometryPose& edge : graph.odometry)
    {
      odometry_.push_back(
          std::make_unique<DriftingMotionFactor>(edge.from_T_to, edge.from_up, inverseOfPositive(edge.covariance)));
      scales_.try_emplace(edge.drive, Eigen::Vector2d::Zero());
    }
    for (const RelativePose& edge : graph.loops)
      loops_.push_back(
          std::make_unique<RelativePoseFactor>(edge.from_T_to, inverseOfPositive(edge.covariance), Rigid::identity()));
    scale_prior_ =
        std::make_unique<ceres::NormalPrior>(Eigen::Matrix2d::Identity() / graph.scale_sigma, Eigen::Vector2d::Zero());
    for (const MeasuredUp& up : graph.ups) ups_.push_back(std::make_unique<UpFactor>(up.body_up, up.sigma));
    for (const MeasuredPosition& at : graph.positions)
      positions_.push_back(std::make_unique<PositionFactor>(at.body_p_point, at.map_p_point, at.covariance));
    if (graph.fixed)
    {
      const Rigid& fixed = graph.map_T_body[*graph.fixed];
      gauge_ = std::make_unique<PosePriorFactor>(fixed, gaugeInformation(fixed), Rigid::identity());
    }
  }

  /** From all loops and positions to those that agree with each other and the rest. */
  void solve()
  {
    minimise();
    double mu = std::min(loop_weights_.firstMu(squaresOfLoops()), position_weights_.firstMu(squaresOfPositions()));
    if (std::isinf(mu)) return;
    for (int round = 0; round < kMostRounds; ++round, mu *= kConvexityStep)
    {
      loop_weights_.update(squaresOfLoops(), mu);
      position_weights_.update(squaresOfPositions(), mu);
      minimise();
      if (loop_weights_.areDecided() && position_weights_.areDecided()) break;
    }
  }

  SolvedPoseGraph result()
  {
    SolvedPoseGraph result;
    for (const PoseBlock& block : blocks_) result.map_T_body.push_back(poseOf(block.data()));
    rootOfInformation();  // throws where nothing holds the graph
    result.loops_used = loop_weights_.used();
    result.positions_used = position_weights_.used();
    for (const double square : squaresOfLoops()) result.loop_distances.push_back(std::sqrt(square));
    for (const double square : squaresOfPositions()) result.position_distances.push_back(std::sqrt(square));
    return result;
  }

  /** Blocks on the diagonal of the inverse of the information. */
  std::vector<Matrix6d> covariances()
  {
    const std::unique_ptr<const Root> root = rootOfInformation();
    const auto poses = static_cast<Eigen::Index>(6 * blocks_.size());
    std::vector<Matrix6d> covariances;
    for (Eigen::Index at = 0; at < poses; at += 6)
    {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(root->cols(), 6);
      unit.block<6, 6>(at, 0).setIdentity();
      covariances.push_back(root->solve(unit).block<6, 6>(at, 0));
    }
    return covariances;
  }

 private:
  static double squaredDistance(const ceres::CostFunction& factor, const std::vector<const double*>& blocks)
  {
    Eigen::VectorXd residual(factor.num_residuals());
    factor.Evaluate(blocks.data(), residual.data(), nullptr);
    return residual.squaredNorm();
  }

  std::vector<double> squaresOfLoops() const
  {
    std::vector<double> squares;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      squares.push_back(
          squaredDistance(*loops_[i], {blocks_[graph_.loops[i].from].data(), blocks_[graph_.loops[i].to].data()}));
    return squares;
  }

  std::vector<double> squaresOfPositions() const
  {
    std::vector<double> squares;
    for (std::size_t i = 0; i < positions_.size(); ++i)
      squares.push_back(squaredDistance(*positions_[i], {blocks_[graph_.positions[i].pose].data()}));
    return squares;
  }

  /** Measurements with a weight of zero are left out. The poses come first, in their order, also in the Jacobian. */
  std::unique_ptr<ceres::Problem> problem()
  {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    auto problem = std::make_unique<ceres::Problem>(options);
    const auto block = [&](std::size_t i) { return blocks_[i].data(); };
    for (PoseBlock& b : blocks_) problem->AddParameterBlock(b.data(), 7, &manifold_);
    for (auto& [drive, scale] : scales_) problem->AddResidualBlock(scale_prior_.get(), nullptr, scale.data());
    for (std::size_t i = 0; i < odometry_.size(); ++i)
    {
      const OdometryPose& edge = graph_.odometry[i];
      problem->AddResidualBlock(odometry_[i].get(), nullptr, block(edge.from), block(edge.to),
                                scales_.at(edge.drive).data());
    }
    for (std::size_t i = 0; i < ups_.size(); ++i)
      problem->AddResidualBlock(ups_[i].get(), nullptr, block(graph_.ups[i].pose));
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (const double w = loop_weights_.at(i); w > 0)
        problem->AddResidualBlock(loops_[i].get(), new ceres::ScaledLoss(nullptr, w, ceres::TAKE_OWNERSHIP),
                                  block(graph_.loops[i].from), block(graph_.loops[i].to));
    for (std::size_t i = 0; i < positions_.size(); ++i)
      if (const double w = graph_.positions[i].share * position_weights_.at(i); w > 0)
        problem->AddResidualBlock(positions_[i].get(), new ceres::ScaledLoss(nullptr, w, ceres::TAKE_OWNERSHIP),
                                  block(graph_.positions[i].pose));
    if (gauge_) problem->AddResidualBlock(gauge_.get(), nullptr, block(*graph_.fixed));
    return problem;
  }

  void minimise()
  {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.num_threads = 1;
    options.max_num_iterations = 50;
    options.function_tolerance = 1e-9;
    options.initial_trust_region_radius = 1e10;  // Gauss-Newton: damping would shorten each step of a long chain
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, problem().get(), &summary);
    if (!summary.IsSolutionUsable()) throw std::runtime_error("pose graph: " + summary.message);
  }

  Eigen::SparseMatrix<double> information()
  {
    ceres::CRSMatrix j;
    problem()->Evaluate({}, nullptr, nullptr, nullptr, &j);
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
        j.num_rows, j.num_cols, static_cast<Eigen::Index>(j.values.size()), j.rows.data(), j.cols.data(),
        j.values.data());
    const Eigen::SparseMatrix<double> by_columns = jacobian;
    return by_columns.transpose() * by_columns;
  }

  using Root = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;

  std::unique_ptr<const Root> rootOfInformation()
  {
    auto root = std::make_unique<const Root>(information());
    if (root->info() != Eigen::Success)
      throw UnheldPoseGraph("pose graph: nothing holds some of its poses in their place");
    return root;
  }

  const PoseGraph& graph_;
  std::vector<PoseBlock> blocks_;
  PoseManifold manifold_;
  std::map<std::size_t, Eigen::Vector2d> scales_;  // by drive
  std::unique_ptr<ceres::NormalPrior> scale_prior_;
  std::vector<std::unique_ptr<DriftingMotionFactor>> odometry_;
  std::vector<std::unique_ptr<RelativePoseFactor>> loops_;
  std::vector<std::unique_ptr<UpFactor>> ups_;
  std::vector<std::unique_ptr<PositionFactor>> positions_;
  std::unique_ptr<PosePriorFactor> gauge_;
  Weights loop_weights_, position_weights_;
};
}  // namespace

SolvedPoseGraph solved(const PoseGraph& graph)
{
  requireSound(graph);
  Problem problem(graph);
  problem.solve();
  return problem.result();
}

std::vector<Matrix6d> covariancesOf(const PoseGraph& graph)
{
  requireSound(graph);
  return Problem(graph).covariances();
}
}  // namespace scanloom
