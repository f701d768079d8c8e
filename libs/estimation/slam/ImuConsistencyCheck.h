/** Checks that the IMU measures the motion that the lidars see, for wrong axes, units and clocks. */
#pragma once
#include "estimation/imu/GyroAgreement.h"
#include "estimation/slam/StateEstimate.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class ImuConsistencyCheck
{
 public:
  explicit ImuConsistencyCheck(const Rigid& body_T_imu) : body_T_imu_(body_T_imu) {}

  /** Samples must be in time order; others, and those that are not finite, are ignored. Keeps the last minute. */
  void add(const ImuSample&);

  /** Every estimate: two registrations in a row give a turn without the IMU. */
  void add(const StateEstimate&);

  /** None if there is too little motion. */
  std::optional<GyroAgreement> agreement() const;

  /** The most important error and how to correct it, for a person; only beyond four standard deviations. */
  std::optional<std::string> complaint() const { return complaint(agreement()); }
  std::optional<std::string> complaint(const std::optional<GyroAgreement>&) const;

 private:
  std::vector<ImuSample> kept() const { return {samples_.begin(), samples_.end()}; }

  Rigid body_T_imu_;
  std::deque<ImuSample> samples_;
  std::deque<BodyTurn> turns_;
  std::optional<StampedPose> last_;  // the last registration, in the local map
};

/**
 * Check before the start: throws std::runtime_error with the unit or the wrong axis if the mean specific force of the
 * samples cannot be that of a machine on its wheels.
 */
void requireGravity(const std::vector<ImuSample>&, const Rigid& body_T_imu);
}  // namespace scanloom
