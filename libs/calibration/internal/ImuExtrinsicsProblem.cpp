#include "calibration/internal/ImuExtrinsicsProblem.h"

#include "base/core/Angle.h"
#include "base/core/Interruption.h"
#include "calibration/internal/ImuExtrinsicsFactor.h"
#include "calibration/internal/ImuExtrinsicsInformation.h"
#include "estimation/graph/ImuFactor.h"
#include "estimation/graph/StateBlocks.h"

#include <ceres/loss_function.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace scanloom
{
namespace
{
constexpr double kHuber = 4;         // standard deviations
constexpr double kClockSigma = 0.1;  // s
// A map by registrations bends slowly: within a piece of the drive all its poses are off alike.
constexpr Duration kPiece = 4s;
constexpr double kDriftOffset = 0.03, kDriftTurn = 0.1 * kDegree;  // m, rad

/** The motions between neighbouring poses, by stamps without the delay. */
std::vector<Preintegration> motionsOf(const Trajectory& poses, std::vector<ImuSample> samples,
                                      const Extrinsics& extrinsics, const ImuBias& bias, const ImuNoise& noise)
{
  for (ImuSample& sample : samples) sample.stamp -= fromSeconds(extrinsics.clock_offset);
  const ImuBuffer buffer(samples);
  std::vector<Preintegration> motions;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    motions.push_back(preintegrate(buffer.between(poses[i].stamp, poses[i + 1].stamp), bias, noise));
  return motions;
}

Eigen::Vector3d turnRate(const Preintegration& motion) { return logSo3(motion.delta.rotation) / motion.duration(); }

/** The number of the piece by pose; each piece has a pose. */
std::vector<std::size_t> piecesOf(const Trajectory& poses)
{
  std::vector<std::size_t> pieces;
  Timestamp begin = poses.front().stamp;
  for (const StampedPose& pose : poses)
  {
    const bool next = pose.stamp - begin >= kPiece;
    if (next) begin = pose.stamp;
    pieces.push_back(pieces.empty() ? 0 : pieces.back() + (next ? 1 : 0));
  }
  return pieces;
}

/** The rotation that makes the mean of the measured force vertical. */
Eigen::Quaterniond levelled(const Trajectory& poses, const std::vector<Preintegration>& motions,
                            const Extrinsics& extrinsics)
{
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < motions.size(); ++i)
    up += poses[i].map_T_body.rotation * (extrinsics.body_T_sensor.rotation * motions[i].delta.velocity);
  return rotationBetween(up, Eigen::Vector3d::UnitZ());
}

/** Unknowns and factors of a drive; Ceres keeps pointers into it. */
class Drive
{
 public:
  Drive(const Trajectory& poses, const std::vector<ImuSample>& samples, const Extrinsics& start, const ImuBias& bias,
        const ImuNoise& noise, const PoseNoise& pose_noise)
    : poses_(poses),
      motions_(motionsOf(poses, samples, start, bias, noise)),
      start_(start),
      map_R_local_(levelled(poses, motions_, start)),
      extrinsics_(blockOf(start.body_T_sensor)),
      piece_of_pose_(piecesOf(poses)),
      problem_(keepingOwnership())
  {
    drifts_.assign(piece_of_pose_.back() + 1, Vector6d::Zero());
    addStates(bias);
    addPoses(pose_noise);
    addMotions(noise);
    problem_.AddParameterBlock(extrinsics_.data(), 7, &manifold_);
  }

  ImuExtrinsicsSolution solve()
  {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.num_threads = 1;
    options.max_num_iterations = 50;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = 1e-7;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return solution();
  }

  ImuBias bias() const { return stateOf(states_[0].pose.data(), states_[0].motion.data(), poses_[0].stamp).bias; }

 private:
  static ceres::Problem::Options keepingOwnership()
  {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void addStates(const ImuBias& bias)
  {
    const Rigid map_T_local{map_R_local_, Eigen::Vector3d::Zero()};
    for (const StampedPose& pose : poses_)
    {
      NavState state{pose.stamp, map_T_local * pose.map_T_body * start_.body_T_sensor, Eigen::Vector3d::Zero(), bias};
      states_.push_back(blocksOf(state));
    }
    for (std::size_t i = 0; i + 1 < states_.size(); ++i)
      states_[i].motion.head<3>() =
          (states_[i + 1].pose.head<3>() - states_[i].pose.head<3>()) / motions_[i].duration();
    states_.back().motion.head<3>() = states_[states_.size() - 2].motion.head<3>();
    for (StateBlocks& state : states_) problem_.AddParameterBlock(state.pose.data(), 7, &manifold_);
  }

  void addPoses(const PoseNoise& noise)
  {
    Vector6d root;
    root << Eigen::Vector3d::Constant(1 / noise.position), Eigen::Vector3d::Constant(1 / noise.rotation);
    for (std::size_t i = 0; i < poses_.size(); ++i)
    {
      const Eigen::Vector3d rate =
          0.5 * (turnRate(motions_[i > 0 ? i - 1 : 0]) + turnRate(motions_[std::min(i, motions_.size() - 1)]));
      add(imuExtrinsicsFactor({poses_[i].map_T_body, root.asDiagonal(), map_R_local_, rate}), &huber_, i,
          {states_[i].pose.data(), states_[i].motion.data(), extrinsics_.data(), tilt_.data(),
           drifts_[piece_of_pose_[i]].data(), &delay_});
    }
  }

  void addMotions(const ImuNoise& noise)
  {
    for (std::size_t i = 0; i < motions_.size(); ++i)
      add(std::make_unique<ImuFactor>(motions_[i], noise), nullptr, i,
          {states_[i].pose.data(), states_[i].motion.data(), states_[i + 1].pose.data(), states_[i + 1].motion.data()});
    addPriors(noise);
  }

  void addPriors(const ImuNoise& noise)
  {
    Eigen::MatrixXd accel = Eigen::MatrixXd::Zero(3, 9);
    accel.rightCols<3>() = Eigen::Matrix3d::Identity() / noise.accel_bias_sigma;
    add(std::make_unique<ceres::NormalPrior>(accel, Eigen::VectorXd::Zero(9)), nullptr, 0, {states_[0].motion.data()});
    add(std::make_unique<ceres::NormalPrior>(Eigen::MatrixXd::Constant(1, 1, 1 / kClockSigma),
                                             Eigen::VectorXd::Constant(1, -start_.clock_offset)),
        nullptr, 0, {&delay_});
    Vector6d root;
    root << Eigen::Vector3d::Constant(1 / kDriftOffset), Eigen::Vector3d::Constant(1 / kDriftTurn);
    for (std::size_t i = 0; i < poses_.size(); ++i)
      if (i == 0 || piece_of_pose_[i] != piece_of_pose_[i - 1])
        add(std::make_unique<ceres::NormalPrior>(Eigen::MatrixXd(root.asDiagonal()), Eigen::VectorXd::Zero(6)), nullptr,
            i, {drifts_[piece_of_pose_[i]].data()});
  }

  void add(std::unique_ptr<ceres::CostFunction> factor, ceres::LossFunction* loss, std::size_t pose,
           const std::vector<double*>& blocks)
  {
    residuals_.push_back(problem_.AddResidualBlock(factor.get(), loss, blocks));
    pose_of_rows_.insert(pose_of_rows_.end(), static_cast<std::size_t>(factor->num_residuals()), pose);
    factors_.push_back(std::move(factor));
  }

  ImuExtrinsicsSolution solution()
  {
    ImuExtrinsicsSolution s;
    const Rigid found = poseOf(extrinsics_.data());
    s.extrinsics = {found, start_.clock_offset + delay_};
    s.step << boxMinus(found, start_.body_T_sensor), delay_;
    ceres::Problem::EvaluateOptions options;
    options.residual_blocks = residuals_;
    for (StateBlocks& state : states_)
    {
      options.parameter_blocks.push_back(state.pose.data());
      options.parameter_blocks.push_back(state.motion.data());
    }
    for (Vector6d& drift : drifts_) options.parameter_blocks.push_back(drift.data());
    for (double* block : {tilt_.data(), extrinsics_.data(), &delay_}) options.parameter_blocks.push_back(block);
    std::vector<double> residuals;
    ceres::CRSMatrix jacobian;
    problem_.Evaluate(options, nullptr, &residuals, nullptr, &jacobian);
    const ExtrinsicsInformation information = informationOfLast7(jacobian, residuals, pose_of_rows_, poses_.size());
    s.information = information.information;
    s.gradients = information.gradients;
    addMisfits(residuals, s);
    return s;
  }

  void addMisfits(const std::vector<double>& residuals, ImuExtrinsicsSolution& s) const
  {
    const auto n = static_cast<Eigen::Index>(poses_.size());
    const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> poses(residuals.data(), 6, n);
    const Eigen::Map<const Eigen::Matrix<double, 15, Eigen::Dynamic>> motions(residuals.data() + 6 * n, 15, n - 1);
    s.residual = {std::sqrt(poses.topRows<3>().array().square().mean()),
                  std::sqrt(poses.bottomRows<3>().array().square().mean())};
    s.motion_misfit = std::sqrt(motions.topRows<9>().array().square().mean());
  }

  const Trajectory& poses_;
  std::vector<Preintegration> motions_;
  Extrinsics start_;
  Eigen::Quaterniond map_R_local_;
  std::vector<StateBlocks> states_;
  PoseBlock extrinsics_;
  std::vector<std::size_t> piece_of_pose_;
  std::vector<Vector6d> drifts_;  // by piece
  Eigen::Vector2d tilt_ = Eigen::Vector2d::Zero();
  double delay_ = 0;  // beyond that of start
  PoseManifold manifold_;
  ceres::HuberLoss huber_{kHuber};
  std::vector<std::unique_ptr<ceres::CostFunction>> factors_;
  std::vector<ceres::ResidualBlockId> residuals_;
  std::vector<std::size_t> pose_of_rows_;
  ceres::Problem problem_;
};
}  // namespace

ImuExtrinsicsSolution solveImuExtrinsics(const Trajectory& poses, const std::vector<ImuSample>& samples,
                                         const Extrinsics& start, const ImuNoise& noise, const PoseNoise& pose_noise)
{
  constexpr int kMostRounds = 6;
  constexpr double kSettledStep = 2e-4;  // m
  Extrinsics extrinsics = start;
  ImuBias bias;
  ImuExtrinsicsSolution solution;
  for (int round = 0; round < kMostRounds; ++round)
  {
    throwIfInterrupted();
    Drive drive(poses, samples, extrinsics, bias, noise, pose_noise);
    solution = drive.solve();
    extrinsics = solution.extrinsics;
    bias = drive.bias();
    if (solution.step.cwiseQuotient(extrinsicsStepOfMetres()).norm() < kSettledStep) break;
  }
  solution.residual.position *= pose_noise.position;
  solution.residual.rotation *= pose_noise.rotation;
  return solution;
}
}  // namespace scanloom
