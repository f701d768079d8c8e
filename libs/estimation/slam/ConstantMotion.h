/** Where there is no IMU: the samples that one in the body's origin would measure at constant velocity and turn rate,
 * if the body stood level: what it does on average. They level no map (Tracker::withKeyframe). */
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
  /** From `start` on; without a turn until the second estimate. */
  explicit ConstantMotion(Timestamp start) : start_(start) {}

  /** The latest estimate. */
  void update(const StateEstimate&);

  /** The latest estimate is in another frame from now on. */
  void enterMap(const Rigid& map_T_drive);

  /** After those given before, the first at the start, up to `end`: at 100 Hz, but about 10,000 at most. */
  std::vector<ImuSample> samplesUntil(Timestamp end);

 private:
  std::optional<StampedPose> latest_;                    // of the body in the map
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();  // rad/s, in the body's frame; fading mean of all
  Timestamp start_;
  std::optional<Timestamp> given_;  // stamp of the last sample
};
}  // namespace scanloom
