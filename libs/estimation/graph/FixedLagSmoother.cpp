#include "estimation/graph/FixedLagSmoother.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/ImuFactor.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/internal/RelativePoseFactor.h"
#include "estimation/graph/internal/Whitening.h"

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
constexpr double kMostInformation = 1e16;  // 1/m2: beyond it rounding hides all other measurements
constexpr double kFarthest = 1e9;          // m

bool isReasonable(const Rigid& pose, const Matrix6d& information)
{
  return pose.translation.allFinite() && pose.translation.norm() < kFarthest &&
         std::abs(pose.rotation.norm() - 1) < 1e-6 && information.allFinite() &&
         information.cwiseAbs().maxCoeff() < kMostInformation;
}

void requireStart(const NavState& initial, const Matrix15d& covariance, const SmootherOptions& options)
{
  if (options.window < 2)
    throw std::invalid_argument(fmt::format("window = {}: a motion joins two states, so two at least", options.window));
  if (!initial.allFinite()) throw std::invalid_argument("the smoother's first state is not finite");
  if (!isPositiveDefinite(covariance))
    throw std::invalid_argument("the covariance of the smoother's first state is not positive definite");
}

ceres::Solver::Options solverOptions(int max_iterations)
{
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  o.num_threads = 1;
  o.max_num_iterations = max_iterations;
  o.logging_type = ceres::SILENT;
  // The scales are sums of squares, which Ceres 2.1 and 2.2 add in another order; Cholesky is as exact without them.
  o.jacobi_scaling = false;
  // The IMU's prediction starts close to the optimum: whole Gauss-Newton steps, damped only where one fails.
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

FixedLagSmoother::FixedLagSmoother(const NavState& initial, const Matrix15d& covariance, const Rigid& body_T_imu,
                                   const ImuNoise& noise, const SmootherOptions& options)
  : body_T_imu_(body_T_imu), noise_(noise), options_(options), states_{initial}
{
  // A state that is not finite would spoil the window without a message, and for good.
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
  while (states_.size() > static_cast<std::size_t>(options_.window + hasAnchor()))
    forget(states_.front().stamp == anchor_);
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
  // Counted, not thrown: a failed registration must not stop a machine.
  if (isReasonable(lidar_pose.pose, lidar_pose.information))
    lidar_poses_.push_back(lidar_pose);
  else
    ++report_.refused;
}

NavState FixedLagSmoother::optimise()
{
  // The first-order correction for the bias ends where the bias has moved too far from its linearisation point.
  for (Preintegration& motion : motions_) motion = corrected(motion, states_[indexOf(motion.from)].bias, noise_);

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
  // Else the predicted states stay, which the IMU alone has made.
  if (report_.usable) states_ = std::move(adjusted);
  return newest();
}

Matrix15d FixedLagSmoother::newestCovariance() const
{
  std::vector<StateBlocks> window = blocks();
  return marginalCovariance(linearFactors(window), {states_.size() - 1});
}

Matrix6d FixedLagSmoother::newestBodyCovariance() const
{
  std::vector<StateBlocks> window = blocks();
  // A measurement of unit information whose Jacobian is that of the pose asked for.
  const std::size_t newest_index = states_.size() - 1, anchor_index = hasAnchor() ? indexOf(*anchor_) : newest_index;
  const Rigid map_T_body = bodyAt(newest());
  Factor pose{std::make_unique<PosePriorFactor>(map_T_body, Matrix6d::Identity(), body_T_imu_), {newest_index}};
  if (anchor_index != newest_index)
  {
    const Rigid anchor_T_body = bodyAt(anchor()).inverse() * map_T_body;
    pose = {std::make_unique<RelativePoseFactor>(anchor_T_body, Matrix6d::Identity(), body_T_imu_),
            {anchor_index, newest_index}};
  }
  const LinearFactor seen = linearise(pose, window);
  return seen.jacobian * marginalCovariance(linearFactors(window), seen.states) * seen.jacobian.transpose();
}

Matrix6d FixedLagSmoother::bodyCovarianceAfter(const Matrix6d& before) const
{
  Matrix6d information = Matrix6d::Zero();
  for (const LidarPose& l : lidar_poses_)
    if (l.stamp == newest().stamp) information += informationOf(l);
  // (before^-1 + information)^-1 without the inverse of `before`, which may be nearly singular.
  const Matrix6d after = solve(Matrix6d::Identity() + before * information, before);
  return 0.5 * (after + after.transpose());
}

/** At the newest body's present pose, with the weight of the robust loss. */
Matrix6d FixedLagSmoother::informationOf(const LidarPose& l) const
{
  const Rigid map_T_reference = l.reference ? bodyAt(states_[indexOf(*l.reference)]) : Rigid::identity();
  const Rigid reference_T_body = map_T_reference.inverse() * bodyAt(newest());
  const Vector6d residual = boxMinus(reference_T_body, l.pose);
  const Matrix6d by_step = boxMinusByStep(reference_T_body, l.pose);
  const double norm = std::sqrt(residual.dot(l.information * residual));
  const double weight = options_.huber > 0 && norm > options_.huber ? options_.huber / norm : 1;
  return weight * by_step.transpose() * l.information * by_step;
}

Rigid FixedLagSmoother::bodyAt(const NavState& state) const { return state.map_T_imu * body_T_imu_.inverse(); }

void FixedLagSmoother::anchorNewest() { anchor_ = newest().stamp; }

void FixedLagSmoother::loosenAnchor(const Matrix6d& step)
{
  if (!hasAnchor() || anchor_ == newest().stamp)
    throw std::invalid_argument("what lidar poses are relative to cannot move before there is one");
  // Poses measured before are part of the new prior: their place has not moved.
  const std::size_t index = indexOf(*anchor_);
  replacePrior(loosened(combined(linearFactorsOf(index)), index, movedTo(body_T_imu_, step)));
  dropFactorsOf(*anchor_);
}

/** The prior, and the factors of the state. */
std::vector<LinearFactor> FixedLagSmoother::linearFactorsOf(std::size_t index) const
{
  std::vector<StateBlocks> window = blocks();
  const std::vector<Factor> all = factors();
  std::vector<LinearFactor> touching{linearise(all.front(), window)};  // the prior
  for (std::size_t i = 1; i < all.size(); ++i)
    if (std::count(all[i].states.begin(), all[i].states.end(), index)) touching.push_back(linearise(all[i], window));
  return touching;
}

void FixedLagSmoother::replacePrior(LinearFactor by)
{
  prior_ = {{}, std::move(by.jacobian), std::move(by.residual)};
  for (const std::size_t state : by.states) prior_.at.push_back(states_[state]);
}

void FixedLagSmoother::dropFactorsOf(Timestamp state)
{
  const auto erase = [](auto& factors, const auto& isOfState)
  { factors.erase(std::remove_if(factors.begin(), factors.end(), isOfState), factors.end()); };
  erase(motions_, [&](const Preintegration& m) { return m.from == state || m.to == state; });
  erase(lidar_poses_, [&](const LidarPose& l) { return l.stamp == state || l.reference == state; });
}

void FixedLagSmoother::forget(std::size_t index)
{
  const Timestamp leaving = states_[index].stamp;
  // The motion to the next state is among them, so the prior will be of one state at least.
  replacePrior(eliminate(linearFactorsOf(index), index));
  states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(index));
  dropFactorsOf(leaving);
}

std::vector<Factor> FixedLagSmoother::factors() const
{
  std::vector<Factor> all;
  std::vector<std::size_t> oldest;
  for (const NavState& s : prior_.at) oldest.push_back(indexOf(s.stamp));
  all.push_back({std::make_unique<MarginalFactor>(prior_), oldest});

  for (const Preintegration& motion : motions_)
    all.push_back({std::make_unique<ImuFactor>(motion, noise_), {indexOf(motion.from), indexOf(motion.to)}});

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

std::vector<LinearFactor> FixedLagSmoother::linearFactors(std::vector<StateBlocks>& window) const
{
  std::vector<LinearFactor> linear;
  for (const Factor& factor : factors()) linear.push_back(linearise(factor, window));
  return linear;
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
