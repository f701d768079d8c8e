#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace scanloom
{
struct GyroInUse
{
  std::string label;                               // of the IMU
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  // rad/s
};

/**
 * Deskews clouds to their stamp by the rotation that a gyroscope measured, about the body's origin, for rawlogs without
 * a trajectory. The translation stays in, since an IMU alone does not tell it. All fields stay, t too. A cloud waits
 * for its IMU samples, and the observations behind it wait with it. Clouds in a gap of the samples (kWidestImuGap) are
 * removed; throws std::runtime_error at the end of input if all were.
 */
RawlogOperation deskewByGyro(const GyroInUse&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
