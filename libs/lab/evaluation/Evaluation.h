/** Compares a trajectory with a reference: drift, APE, RPE, clock offset. */
#pragma once
#include "lab/evaluation/Drift.h"
#include "lab/evaluation/internal/PoseErrors.h"

#include <optional>
#include <variant>

namespace scanloom
{
struct EvaluationOptions
{
  Eigen::Vector3d body_p_point = Eigen::Vector3d::Zero();  // m: the point that is compared, e.g. the prism
  AlignmentKind alignment = AlignmentKind::Yaw;
  bool apply_clock_offset = false;
};

struct EvaluationInput
{
  Trajectory scans;                    // a pose per scan
  std::optional<Trajectory> imu_rate;  // the same run at the IMU's rate

  /** Positions of that point, or poses of the body. */
  std::variant<PositionTrack, Trajectory> reference;

  /** True poses of the body by the clock of the estimate. None: the reference is used, if it has poses. */
  std::optional<Trajectory> truth;
};

struct Evaluation
{
  Drift drift;                          // of the scans' poses, interpolated to the stamps of the reference
  std::optional<Drift> imu_rate_drift;  // of the poses at the IMU's rate
  /** Of the true poses at the scans' stamps: the error that the interpolation between scans causes by itself. */
  std::optional<Drift> floor;
  PoseErrors absolute, relative;         // of the scans' poses
  std::vector<PositionPair> pairs;       // of the scans' poses, at the stamps of the reference
  std::size_t left_out = 0;              // samples of the reference at whose time there is no estimate
  double covered = 0;                    // share of the reference's time at which there is an estimate
  std::optional<Duration> clock_offset;  // how much the reference's stamps are late
  bool clock_offset_applied = false;
};

/** Throws std::invalid_argument if the trajectory and the reference have no time in common. */
Evaluation evaluate(const EvaluationInput&, const EvaluationOptions&);
}  // namespace scanloom
