/** The state that a new window begins with, where the one before cannot go on. */
#pragma once
#include "core/ImuSample.h"
#include "imu/NavState.h"
#include "imu/Preintegration.h"

#include <vector>

namespace scanloom
{
/** Another IMU, elsewhere in the body. */
struct ImuChange
{
  Rigid body_T_imu;
  ImuNoise noise;
  std::vector<ImuSample> samples;   // its own so far, back to the newest state or farther
  std::vector<ImuSample> previous;  // what the one before read at the same time, as far as it did
};

/**
 * The newest state of the IMU before, as the other one has it: with the biases that the first tells of it, where both
 * were heard for long enough (biasBeside), and unsure of what happened while the first was silent and its last reading
 * was held.
 */
NavEstimate continuedBy(const ImuChange&, const NavEstimate& newest, const Rigid& body_T_imu_before);

/**
 * A body that was found again, as surely as `body_covariance` says and the map is level by `accel_bias_sigma` (m/s2);
 * how fast it goes is not known. Biases are `bias`, as surely as those of `newest`.
 */
NavEstimate foundAt(const Rigid& map_T_body, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const ImuBias& bias, const Rigid& body_T_imu, double accel_bias_sigma);
}  // namespace scanloom
