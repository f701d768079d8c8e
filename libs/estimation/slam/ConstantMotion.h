/** Where there is no IMU: the samples that one in the body's origin would measure at constant velocity and turn rate.
 */
#pragma once
#include "base/core/ImuSample.h"
#include "estimation/slam/StateEstimate.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** The velocity is the smoother's, because the samples hold no acceleration. */
class ConstantMotion
{
 public:
  /** From `start` on; until the first estimate the body is taken for level, without a turn. */
  explicit ConstantMotion(Timestamp start) : given_(start) {}

  /** The latest estimate. */
  void update(const StateEstimate&);

  /** The latest estimate is in another frame from now on. */
  void enterMap(const Rigid& map_T_drive);

  /** After those given before, up to `end`: at 100 Hz, but 10,000 at most. */
  std::vector<ImuSample> samplesUntil(Timestamp end);

 private:
  std::optional<StampedPose> latest_;                    // of the body in the map
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();  // rad/s, in the body's frame
  Timestamp given_;
};
}  // namespace scanloom
