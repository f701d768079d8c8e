/** A machine whose motion is a formula, with an IMU on it. */
#pragma once
#include "estimation/imu/AnalyticDrive.h"
#include "estimation/slam/internal/SlamSettings.h"

#include <algorithm>

namespace scanloom
{
inline const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.2, -0.3, 1.5, 0.5, 0.02, -0.01);

/** The body moves by a formula (the IMU's place is worked out from it); optionally it stands for three seconds first.
 */
struct Machine
{
  AnalyticDrive drive;  // of the IMU
  Duration standstill{0};

  NavState imuAt(Timestamp t) const { return drive.stateAt(std::max(t, Timestamp{standstill}) - standstill); }
  Rigid bodyAt(Timestamp t) const { return imuAt(t).map_T_imu * kBodyTImu.inverse(); }

  ImuSample sampleAt(Timestamp t) const
  {
    ImuSample sample = drive.sampleAt(std::max(t, Timestamp{standstill}) - standstill);
    sample.stamp = t;
    if (t < Timestamp{standstill})
    {
      sample.gyro.setZero();
      sample.accel = imuAt(t).map_T_imu.rotation.conjugate() * -gravityInMap();
    }
    return sample;
  }
};

/** About 1 m/s, rolling and pitching gently; every sine begins with rate zero, so that it can follow a standstill. */
inline Machine gentleMachine(Duration standstill)
{
  Machine machine;
  machine.standstill = standstill;
  machine.drive.x = {0, 1.0, -1.0 / 0.9, 0.9, 0};
  machine.drive.y = {0, 0, 0, 1, 0};
  machine.drive.z = {1.5, 0, 0, 1, 0};
  machine.drive.yaw = {-0.5, 0, 0, 1, 0};
  machine.drive.pitch = {0.0, 0.02, -0.02 / 1.3, 1.3, 0};
  machine.drive.roll = {0.0, -0.01, 0.01 / 1.1, 1.1, 0};
  return machine;
}

/** With a box around the machine that is cropped out. */
inline SlamSettings withMachineBox(SlamSettings settings = {})
{
  settings.crop.min_x = -4, settings.crop.max_x = 3;
  settings.crop.min_y = -2, settings.crop.max_y = 2;
  settings.crop.min_z = -0.5, settings.crop.max_z = 6;
  return settings;
}
}  // namespace scanloom
