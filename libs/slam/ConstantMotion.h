/** Instead of an IMU, for comparison: the samples that it would measure at constant velocity and turn rate. */
#pragma once
#include "core/ImuSample.h"
#include "slam/StateEstimate.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** The velocity is the smoother's, because the samples hold no acceleration. */
class ConstantMotion
{
 public:
  explicit ConstantMotion(const Rigid& body_T_imu) : body_T_imu_(body_T_imu) {}

  /** The latest estimate. */
  void update(const StateEstimate&);

  /** At 100 Hz, after those given before, up to `end`; none before the first estimate. */
  std::vector<ImuSample> samplesUntil(Timestamp end);

  bool known() const { return latest_.has_value(); }

 private:
  Rigid body_T_imu_;
  std::optional<StampedPose> latest_;                    // of the IMU in the map
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();  // rad/s, in the IMU's frame
  Timestamp given_;
};
}  // namespace scanloom
