/** Clouds without the distortion of the body's own turning, where no trajectory is known. */
#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

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
 * Clouds turned to their stamp by the gyroscope's rates, about the body's origin: how the body moves meanwhile an IMU
 * alone does not tell, so that much of the distortion stays. All fields stay, t too. A cloud waits for its samples,
 * and what is behind it in the file waits with it; clouds in a gap of the samples (kWidestImuGap) go. Throws
 * std::runtime_error at the end of input if all clouds would.
 */
RawlogOperation deskewByGyro(const GyroInUse&, const std::optional<RecordingHeader>&);
}  // namespace scanloom
