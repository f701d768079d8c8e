/** Whether the IMU tells the motion that the lidars see: wrong axes, units and clocks have names. */
#pragma once
#include "imu/GyroAgreement.h"
#include "slam/StateEstimate.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class ImuWatch
{
 public:
  explicit ImuWatch(const Rigid& body_T_imu) : body_T_imu_(body_T_imu) {}

  /** In time order, else it is left out, as what is not finite; the last minute is kept. */
  void add(const ImuSample&);

  /** Every one: its registration against that of the last one tells a turn that the IMU had no part in. */
  void add(const StateEstimate&);

  /** None while they share too little motion to tell. */
  std::optional<GyroAgreement> agreement() const;

  /** For a person: what is wrong first of all, and how to mend it; only what is beyond doubt. */
  std::optional<std::string> complaint() const { return complaint(agreement()); }
  std::optional<std::string> complaint(const std::optional<GyroAgreement>&) const;

 private:
  std::vector<ImuSample> kept() const { return {samples_.begin(), samples_.end()}; }

  Rigid body_T_imu_;
  std::deque<ImuSample> samples_;
  std::deque<BodyTurn> turns_;
  std::optional<StampedPose> last_;  // as it was registered
};

/**
 * A first look, before anything is built on it: throws std::runtime_error that names the unit or the wrong axis if the
 * mean specific force of the samples cannot be that of a machine that stands on its wheels.
 */
void requireGravity(const std::vector<ImuSample>&, const Rigid& body_T_imu);
}  // namespace scanloom
