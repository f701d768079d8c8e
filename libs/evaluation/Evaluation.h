/** Everything that is said about a trajectory once a reference is at hand. */
#pragma once
#include "evaluation/Drift.h"
#include "evaluation/PoseErrors.h"

#include <optional>
#include <variant>

namespace scanloom
{
struct EvaluationOptions
{
  Eigen::Vector3d body_p_point = Eigen::Vector3d::Zero();  // m: the prism, the "lever arm"
  AlignmentKind alignment = AlignmentKind::Yaw;
  bool apply_clock_offset = false;
  RelativeDelta delta;
};

struct EvaluationInput
{
  Trajectory scans;                    // a pose per scan
  std::optional<Trajectory> imu_rate;  // the same run at the IMU's rate

  /** Positions of the point, or poses of the body. */
  std::variant<PositionTrack, Trajectory> reference;

  /** True poses of the body by the estimate's clock; without them poses as reference serve. */
  std::optional<Trajectory> truth;
};

struct Evaluation
{
  Drift drift;                           // of the scans' poses
  std::optional<Drift> imu_rate_drift;   // without the chords between scans
  std::optional<Drift> floor;            // of the truth itself, known at the scans' stamps only: what chords alone cost
  PoseErrors absolute, relative;         // of the scans' poses
  std::size_t left_out = 0;              // samples of the reference without an estimate
  std::optional<Duration> clock_offset;  // by which the reference's stamps are late
  bool clock_offset_applied = false;
};

/** Throws std::invalid_argument if the trajectory and the reference share no time. */
Evaluation evaluate(const EvaluationInput&, const EvaluationOptions&);
}  // namespace scanloom
