/** The state with which a new window begins where the previous window ends. */
#pragma once
#include "base/core/ImuSample.h"
#include "estimation/imu/NavState.h"
#include "estimation/imu/Preintegration.h"

#include <vector>

namespace scanloom
{
/** An IMU, where it is and how noisy. */
struct MountedImu
{
  Rigid body_T_imu;
  ImuNoise noise;
  bool assumed = false;  // there is none: the samples are ConstantMotion's
};

/** Another IMU takes over. */
struct ImuChange
{
  MountedImu imu;
  std::vector<ImuSample> samples;   // its own so far, back to the newest state or farther
  std::vector<ImuSample> previous;  // what the IMU before read at the same time, as far as it did
};

/**
 * The newest state of the IMU before, as the state of the new one. Its biases follow from those of the IMU before where
 * both have samples of the same time (biasOfReplacement). The new one's accel_bias_sigma then corrects the tilt: an
 * accelerometer that is known well levels the map of one that is not. The covariance covers the motion while the IMU
 * before was silent and its last sample was held.
 */
NavEstimate continuedBy(const ImuChange&, const NavEstimate& newest, const Rigid& body_T_imu_before);

/**
 * The state of a body that was found again with this covariance, in a map that is level within accel_bias_sigma /
 * gravity. The velocity is unknown. The biases are `bias` with the covariance that they have in `newest`.
 */
NavEstimate foundAt(const Rigid& map_T_body, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const ImuBias& bias, const MountedImu&);

/**
 * The newest state in the frame of another level map, in which the body's pose has this covariance and the map is level
 * within accel_bias_sigma / gravity. Velocity and biases stay as well known as they are, each by itself.
 */
NavEstimate inFrame(const Rigid& map_T_drive, const Matrix6d& body_covariance, const NavEstimate& newest,
                    const MountedImu&);

/** Whether the velocity is known better than atRest() assumes it. */
bool knowsVelocity(const NavEstimate&);

/**
 * The newest state with another pose of the body and no velocity, with a standard deviation of 1 m/s. `tilt_sigma`: by
 * how much the tilt of that pose is less certain than that of the newest state (rad).
 */
NavEstimate atRest(const Rigid& map_T_body, double tilt_sigma, const NavEstimate& newest, const MountedImu&);
}  // namespace scanloom
