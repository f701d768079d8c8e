/** The first state: which way is up, and what the gyroscope reads at rest. */
#pragma once
#include "core/Field.h"
#include "core/ImuSample.h"
#include "imu/NavState.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** When samples count as taken at rest; the limits let an idling engine pass but not a slow motion. */
struct StandstillOptions
{
  double duration = 2.0;
  double max_accel_deviation = 1.0;
  double max_gyro_deviation_deg = 3.0;
  double max_slow_share = 0.3;
  double max_mean_gyro_deg = 2.0;
  double max_gravity_error = 0.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.duration, Field{"duration", "s", "standstill needed", above(0)});
    visit(o.max_accel_deviation,
          Field{"max_accel_deviation", "m/s2", "standard deviation (3 axes) that the engine may cause", above(0)});
    visit(o.max_gyro_deviation_deg,
          Field{"max_gyro_deviation_deg", "deg/s", "standard deviation (3 axes) that the engine may cause", above(0)});
    visit(o.max_slow_share, Field{"max_slow_share", "",
                                  "of the deviation, how much may be left in means over 1/8 of the duration: "
                                  "vibration averages out, motion does not",
                                  between(0, 1)});
    visit(o.max_mean_gyro_deg,
          Field{"max_mean_gyro_deg", "deg/s", "a larger mean rate is a turn, not a bias", above(0)});
    visit(o.max_gravity_error,
          Field{"max_gravity_error", "m/s2", "of the mean accelerometer's length against 9.80665", above(0)});
  }
};

/** What the samples looked like: standard deviations over three axes, and those of the means of eight equal parts. */
struct ImuStatistics
{
  Eigen::Vector3d mean_gyro = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d mean_accel = Eigen::Vector3d::Zero();  // m/s2
  double gyro_deviation = 0;                             // rad/s
  double accel_deviation = 0;                            // m/s2
  double slow_gyro_deviation = 0;                        // rad/s
  double slow_accel_deviation = 0;                       // m/s2
};

struct ImuInitialisation
{
  /** At the last sample: the body at the map's origin with yaw 0, velocity zero. */
  NavState state;

  /**
   * Tangent order of NavState. Tilt and horizontal accelerometer bias cannot be told apart at rest: they are
   * correlated here, and the smoother parts them once the machine turns.
   */
  Matrix15d covariance = Matrix15d::Zero();
  ImuStatistics statistics;
  bool at_rest = false;
};

ImuStatistics statisticsOf(const std::vector<ImuSample>&);

/**
 * From the last `duration` of the samples; nothing if they are fewer or not at rest. The gyro bias is the mean rate.
 * Of the accelerometer's bias only the part along gravity shows, as |mean| - 9.80665, and is taken (it includes what
 * local gravity differs from standard gravity, at most 0.03 m/s2); across it is left at zero, with `accel_bias_sigma`
 * (m/s2), and tilts the map by bias / gravity. Throws std::invalid_argument if stamps do not increase.
 */
std::optional<ImuInitialisation> initialiseAtRest(const std::vector<ImuSample>&, const Rigid& body_T_imu,
                                                  const StandstillOptions&, double accel_bias_sigma = 0.05);

/**
 * For a start while moving or on too few samples: up is where the mean accelerometer points, biases zero, velocity
 * zero with a wide covariance, at_rest false. Throws std::invalid_argument if there is no sample or no specific force.
 */
ImuInitialisation gravityOnly(const std::vector<ImuSample>&, const Rigid& body_T_imu, double accel_bias_sigma = 0.05);
}  // namespace scanloom
