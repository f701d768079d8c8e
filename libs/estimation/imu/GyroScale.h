/** The unit of a gyroscope, by the accelerometer beside it: gravity must turn as the gyroscope measures. */
#pragma once
#include "base/core/ImuSample.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct GyroScale
{
  double scale = 1;  // true turn rate over the gyroscope's: 1 for rad/s, 0.01745 for deg/s
  double sigma = 0;  // standard deviation
  double explained =
      0;  // share of the force's changes that turning gravity explains; small where a road shakes the IMU
  double tilt_rate = 0;  // rad/s, mean about horizontal axes; the mean of a true rate is zero
};

/**
 * Let phi be the change of the gyroscope's integral in half a second, dw the change of its angular acceleration, and r
 * the IMU's position from the centre of rotation. Then the specific force f changes by
 *
 *   df = -scale phi x f + dw x (scale r)
 *
 * which is linear in scale and in (scale r). Means (bias, slope) are removed; accelerations of the drive are noise.
 * None for less than 5 s of samples.
 */
std::optional<GyroScale> gyroScale(const std::vector<ImuSample>&);
}  // namespace scanloom
