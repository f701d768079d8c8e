/** The first state: attitude by gravity, and the biases at rest. */
#pragma once
#include "base/core/Field.h"
#include "base/core/ImuSample.h"
#include "estimation/imu/NavState.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** Limits for samples at rest. An engine, however strong, is within them; a slow motion is not. */
struct StandstillOptions
{
  double duration = 2.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.duration, Field{"duration", "s", "length of the standstill", atLeast(1)});
  }
};

/**
 * The state at the last sample: the body at the map's origin with yaw 0, velocity zero. Tilt and horizontal
 * accelerometer bias cannot be separated at rest: they are correlated in the covariance, and the smoother separates
 * them when the machine turns.
 *
 * From the last `duration` of the samples; none if they are fewer or not at rest. The gyro bias is the mean rate. Of
 * the accelerometer's bias only the part along gravity is observable, as |mean| - 9.80665 (which includes the
 * difference of local from standard gravity, at most 0.03 m/s2). The part across gravity is left at zero with the
 * deviation `accel_bias_sigma` (m/s2); it tilts the map by bias / gravity. Throws std::invalid_argument if stamps do
 * not increase.
 */
std::optional<NavEstimate> initialiseAtRest(const std::vector<ImuSample>&, const Rigid& body_T_imu,
                                            const StandstillOptions&, double accel_bias_sigma = 0.05);

/**
 * For a start in motion or with too few samples: up is the direction of the mean specific force; biases and velocity
 * are zero with a wide covariance. Throws std::invalid_argument if there is no sample or no specific
 * force.
 */
NavEstimate gravityOnly(const std::vector<ImuSample>&, const Rigid& body_T_imu, double accel_bias_sigma = 0.05);

/** For a start without an IMU: the map is as level as the body is, whose attitude is exact; the velocity is unknown. */
NavEstimate levelWithBody(Timestamp);
}  // namespace scanloom
