/** Whether a gyroscope speaks rad/s: the turn that it tells must carry the accelerometer's gravity along. */
#pragma once
#include "core/ImuSample.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct GyroScale
{
  double scale = 1;      // the true turn rate is this times the gyroscope's: 1 for rad/s, 0.01745 for deg/s
  double sigma = 0;      // standard deviation
  double tilt_rate = 0;  // rad/s, mean about horizontal axes: gravity would turn so fast, for ever
};

/**
 * Over half a second, with phi the gyroscope's integral and dw the change of its angular acceleration, the specific
 * force f of an IMU that sits at r from where the body turns changes by
 *
 *   df = -scale phi x f + dw x (scale r)
 *
 * which is linear in the scale, whatever it is, and in (scale r). What turns slowly or not at all (bias, slope) is
 * taken out; accelerations of the drive are noise. None for less than 5 s of samples.
 */
std::optional<GyroScale> gyroScale(const std::vector<ImuSample>&);
}  // namespace scanloom
