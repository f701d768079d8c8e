#include "graph/FixedLagSmoother.h"

#include "graph/ImuFactor.h"
#include "graph/PosePriorFactor.h"
#include "graph/RelativePoseFactor.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kSharpest = 1e16;  // 1/m2: beyond it squares lose every digit of the rest
constexpr double kFarthest = 1e9;   // m

bool isReasonable(const Rigid& pose, const Matrix6d& information)
{
  return pose.translation.allFinite() && pose.translation.norm() < kFarthest &&
         std::abs(pose.rotation.norm() - 1) < 1e-6 && information.allFinite() &&
         information.cwiseAbs().maxCoeff() < kSharpest;
}

void requireStart(const NavState& initial, const Matrix15d& covariance, const SmootherOptions& options)
{
  if (options.window < 2)
    throw std::invalid_argument(fmt::format("window = {}: a motion joins two states, so two at least", options.window));
  if (!initial.allFinite()) throw std::invalid_argument("the smoother's first state is not finite");
  if (!covariance.allFinite() || covariance.llt().info() != Eigen::Success)
    throw std::invalid_argument("the covariance of the smoother's first state is not positive definite");
}

ceres::Solver::Options solverOptions(int max_iterations)
{
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  o.num_threads = 1;
  o.max_num_iterations = max_iterations;
  o.logging_type = ceres::SILENT;
  // The IMU's prediction starts within a hair of the optimum: whole Gauss-Newton steps, damped only where one fails.
  o.initial_trust_region_radius = 1e12;
  o.max_trust_region_radius = 1e20;
  o.function_tolerance = 1e-8;
  o.parameter_tolerance = 1e-10;
  return o;
}

/** Adjusts the window in place. */
ceres::Solver::Summary solve(const std::vector<Factor>& factors, std::vector<StateBlocks>& window, int max_iterations)
{
  PoseManifold manifold;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses;
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);

  for (StateBlocks& state : window)
  {
    problem.AddParameterBlock(state.pose.data(), static_cast<int>(state.pose.size()), &manifold);
    problem.AddParameterBlock(state.motion.data(), static_cast<int>(state.motion.size()));
  }
  for (const Factor& factor : factors)
  {
    losses.push_back(factor.huber > 0 ? std::make_unique<ceres::HuberLoss>(factor.huber) : nullptr);
    problem.AddResidualBlock(factor.cost.get(), losses.back().get(), parametersOf(factor, window));
  }

  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(max_iterations), &problem, &summary);
  return summary;
}
}  // namespace

std::string SmootherReport::brief() const
{
  return fmt::format("{} after {} iterations, cost {:.3g} -> {:.3g}, {} lidar poses refused",
                     !usable     ? "failed"
                     : converged ? "converged"
                                 : "stopped",
                     iterations, initial_cost, final_cost, refused);
}

FixedLagSmoother::FixedLagSmoother(const NavState& initial, const Matrix15d& covariance, const Rigid& body_T_imu,
                                   const ImuNoise& noise, const SmootherOptions& options)
  : body_T_imu_(body_T_imu), noise_(noise), options_(options), states_{initial}
{
  requireStart(initial, covariance, options);
  prior_ = priorOf(initial, covariance);
}

void FixedLagSmoother::addState(Preintegration motion)
{
  if (motion.from != newest().stamp || motion.to <= motion.from)
    throw std::invalid_argument(fmt::format("a motion from {} to {} ns cannot follow the state of {} ns",
                                            nanoseconds(motion.from), nanoseconds(motion.to),
                                            nanoseconds(newest().stamp)));
  const NavState predicted = predict(newest(), motion);
  if (!predicted.allFinite() || !motion.covariance.allFinite())
    throw std::invalid_argument(fmt::format("the motion from {} ns is not finite", nanoseconds(motion.from)));

  states_.push_back(predicted);
  motions_.push_back(std::move(motion));
  while (states_.size() > static_cast<std::size_t>(options_.window)) forgetOldest();
}

void FixedLagSmoother::addPosePrior(const Rigid& map_T_body, const Matrix6d& information)
{
  add({newest().stamp, std::nullopt, map_T_body, information});
}

void FixedLagSmoother::addRelativePose(Timestamp reference, const Rigid& reference_T_body, const Matrix6d& information)
{
  const std::size_t index = indexOf(reference);
  if (index + 1 >= states_.size())
    throw std::invalid_argument(fmt::format("no older state of {} ns is in the window", nanoseconds(reference)));
  add({newest().stamp, reference, reference_T_body, information});
}

void FixedLagSmoother::add(const LidarPose& lidar_pose)
{
  if (isReasonable(lidar_pose.pose, lidar_pose.information))
    lidar_poses_.push_back(lidar_pose);
  else
    ++report_.refused;
}

NavState FixedLagSmoother::optimise()
{
  for (std::size_t k = 0; k < motions_.size(); ++k) motions_[k] = corrected(motions_[k], states_[k].bias, noise_);

  std::vector<StateBlocks> window = blocks();
  const ceres::Solver::Summary summary = solve(factors(), window, options_.max_iterations);

  std::deque<NavState> adjusted;
  for (std::size_t k = 0; k < window.size(); ++k)
    adjusted.push_back(stateOf(window[k].pose.data(), window[k].motion.data(), states_[k].stamp));
  const bool finite = std::all_of(adjusted.begin(), adjusted.end(), [](const NavState& s) { return s.allFinite(); });

  report_ = {static_cast<int>(summary.iterations.size()) - 1,
             summary.initial_cost,
             summary.final_cost,
             summary.termination_type == ceres::CONVERGENCE,
             summary.IsSolutionUsable() && finite,
             report_.refused};
  if (report_.usable) states_ = std::move(adjusted);
  return newest();
}

Matrix15d FixedLagSmoother::newestCovariance() const
{
  std::vector<StateBlocks> window = blocks();
  std::vector<LinearFactor> linear;
  for (const Factor& factor : factors()) linear.push_back(linearise(factor, window));
  return marginalCovarianceOfLast(std::move(linear), states_.size());
}

void FixedLagSmoother::forgetOldest()
{
  const Timestamp leaving = states_.front().stamp;
  std::vector<StateBlocks> window = blocks();
  std::vector<LinearFactor> touching;
  for (const Factor& factor : factors())
    if (std::count(factor.states.begin(), factor.states.end(), 0u)) touching.push_back(linearise(factor, window));

  // The motion to the next state is among them, so that the states left over are never none.
  LinearFactor left = eliminate(touching, 0);
  states_.pop_front();
  motions_.pop_front();
  const auto isOfLeaving = [&](const LidarPose& l) { return l.stamp == leaving || l.reference == leaving; };
  lidar_poses_.erase(std::remove_if(lidar_poses_.begin(), lidar_poses_.end(), isOfLeaving), lidar_poses_.end());

  prior_ = {{}, std::move(left.jacobian), std::move(left.residual)};
  for (const std::size_t state : left.states) prior_.at.push_back(states_[state - 1]);
}

std::vector<Factor> FixedLagSmoother::factors() const
{
  std::vector<Factor> all;
  std::vector<std::size_t> oldest;
  for (const NavState& s : prior_.at) oldest.push_back(indexOf(s.stamp));
  all.push_back({std::make_unique<MarginalFactor>(prior_), oldest});

  for (std::size_t k = 0; k < motions_.size(); ++k)
    all.push_back({std::make_unique<ImuFactor>(motions_[k], noise_), {k, k + 1}});

  for (const LidarPose& l : lidar_poses_)
  {
    if (l.reference)
      all.push_back({std::make_unique<RelativePoseFactor>(l.pose, l.information, body_T_imu_),
                     {indexOf(*l.reference), indexOf(l.stamp)},
                     options_.huber});
    else
      all.push_back(
          {std::make_unique<PosePriorFactor>(l.pose, l.information, body_T_imu_), {indexOf(l.stamp)}, options_.huber});
  }
  return all;
}

std::vector<StateBlocks> FixedLagSmoother::blocks() const
{
  std::vector<StateBlocks> window;
  for (const NavState& s : states_) window.push_back(blocksOf(s));
  return window;
}

std::size_t FixedLagSmoother::indexOf(Timestamp stamp) const
{
  const auto state = std::find_if(states_.begin(), states_.end(), [&](const NavState& s) { return s.stamp == stamp; });
  return static_cast<std::size_t>(state - states_.begin());
}
}  // namespace scanloom
