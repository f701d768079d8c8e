#pragma once
#include "base/core/ImuSample.h"

#include <vector>

namespace scanloom
{
/** Means and slow motion of readings, to tell a machine at rest with its engine running from one that moves. */
struct SlowMotion
{
  Eigen::Vector3d mean_gyro, mean_accel;  // rad/s, m/s2: weighted by a Hann window, which vibration does not reach
  double gyro, accel;                     // slow motion, root mean square of 3 axes: below 3 Hz, above the noise
  double gyro_sigma, accel_sigma;         // standard deviations of the means, of each axis
  double gyro_all, accel_all;             // root mean square of all changes, vibration and noise included
};

/**
 * By the spectrum. An engine's power lies in lines above 5 Hz; noise and the shaking of panels are as strong at 3 Hz as
 * at 20 Hz. What is left below 3 Hz is motion: sway, a slope, a turn; and a little of the vibration above half of the
 * IMU's rate (aliasing). The samples are of one second at least, in time order.
 */
SlowMotion slowMotion(const std::vector<ImuSample>&);
}  // namespace scanloom
