/** When `scanloom doctor` warns, and when it calls a rig not fit for SLAM. */
#pragma once
#include "core/Field.h"

namespace scanloom
{
struct DeliveryLimits
{
  double rate_tolerance = 0.02;
  double loss_warning = 0.001;
  double loss_not_fit = 0.05;
  double gap_not_fit = 0.5;
  double damaged_warning = 0.001;
  double invalid_warning = 0.02;
  double invalid_not_fit = 0.5;
  double late_not_fit = 0.01;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.rate_tolerance,
          Field{"rate_tolerance", "", "rate of packets, lost ones included, off nominal: no motor is that far off",
                between(0, 1)});
    visit(o.loss_warning,
          Field{"loss_warning", "", "share of lost packets: a wired network loses none", between(0, 1)});
    visit(o.loss_not_fit,
          Field{"loss_not_fit", "", "share of lost packets: turns have holes of many degrees", between(0, 1)});
    visit(o.gap_not_fit,
          Field{"gap_not_fit", "s", "longest silence: registration must bridge so much motion", above(0)});
    visit(o.damaged_warning,
          Field{"damaged_warning", "", "share of packets of wrong size or CRC: cable or metadata", between(0, 1)});
    visit(o.invalid_warning,
          Field{"invalid_warning", "", "share of blocks that the sensor calls invalid", between(0, 1)});
    visit(o.invalid_not_fit, Field{"invalid_not_fit", "", "the same: half of the turn is missing", between(0, 1)});
    visit(o.late_not_fit,
          Field{"late_not_fit", "", "share of packets that come after deadline_ms and are dropped", between(0, 1)});
  }
};

struct ClockLimits
{
  double offset_warning_ms = 2;
  double offset_not_fit_ms = 20;
  double drift_warning_ppm = 5;
  double drift_time = 5;
  double step_ms = 1;
  double rotor_tolerance = 0.02;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.offset_warning_ms,
          Field{"offset_warning_ms", "ms",
                "clock against the first lidar's: beyond what packet sizes and switches explain", above(0)});
    visit(o.offset_not_fit_ms, Field{"offset_not_fit_ms", "ms",
                                     "the same: at 30 deg/s two lidars see a stem at 10 m 10 cm apart", above(0)});
    visit(o.drift_warning_ppm,
          Field{"drift_warning_ppm", "ppm",
                "clock rate against the first lidar's, if larger than three standard deviations: nobody disciplines it",
                above(0)});
    visit(o.drift_time, Field{"drift_time", "s", "no drift is told from less recording", above(0)});
    visit(o.rotor_tolerance,
          Field{"rotor_tolerance", "", "turn rate off nominal: no motor is that far off", between(0, 1)});
    visit(o.step_ms, Field{"step_ms", "ms", "a jump of stamps that no rotor makes is the clock's", above(0)});
  }
};

struct ImuLimits
{
  double gravity_warning = 0.5;
  double tilt_warning_deg = 15;
  double tilt_not_fit_deg = 45;
  double gyro_scale_factor = 2;
  double gyro_angle_warning_deg = 3;
  double gyro_angle_not_fit_deg = 15;
  double imu_lag_warning_ms = 20;
  double imu_gap_not_fit = 0.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.gravity_warning,
          Field{"gravity_warning", "m/s2", "mean specific force off 9.81: ten times the bias of a good accelerometer",
                above(0)});
    visit(o.tilt_warning_deg,
          Field{"tilt_warning_deg", "deg", "up against the body's z: steeper than most forest roads", above(0)});
    visit(o.tilt_not_fit_deg, Field{"tilt_not_fit_deg", "deg", "the same: no machine stands like that", above(0)});
    visit(o.gyro_scale_factor,
          Field{"gyro_scale_factor", "",
                "gravity turns so many times more or less than the gyroscope tells, beyond three standard deviations: "
                "no calibration is that wrong, a unit is",
                above(1)});
    visit(o.gyro_angle_warning_deg,
          Field{"gyro_angle_warning_deg", "deg", "between two IMUs on one body: more than a bracket is off", above(0)});
    visit(o.gyro_angle_not_fit_deg, Field{"gyro_angle_not_fit_deg", "deg",
                                          "the same: deskewing with that IMU turns scans the wrong way", above(0)});
    visit(o.imu_lag_warning_ms,
          Field{"imu_lag_warning_ms", "ms", "between two IMUs: at 30 deg/s an attitude error of 0.6 deg", above(0)});
    visit(o.imu_gap_not_fit,
          Field{"imu_gap_not_fit", "s", "longest gap: the motion of several scans is unknown", above(0)});
  }
};

struct GeometryLimits
{
  double ground_tilt_warning_deg = 15;
  double ground_tilt_not_fit_deg = 45;
  double ground_angle_warning_deg = 3;
  double ground_height_warning = 0.15;
  double near_share_warning = 0.5;
  double pose_offset_warning = 0.1;
  double pose_offset_not_fit = 0.25;
  double pose_angle_warning_deg = 1;
  double pose_angle_not_fit_deg = 3;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.ground_tilt_warning_deg,
          Field{"ground_tilt_warning_deg", "deg",
                "ground plane's normal against the body's z: steeper than forest roads", above(0)});
    visit(o.ground_tilt_not_fit_deg,
          Field{"ground_tilt_not_fit_deg", "deg", "the same: the pose names a wrong axis", above(0)});
    visit(o.ground_angle_warning_deg, Field{"ground_angle_warning_deg", "deg",
                                            "between two lidars' ground planes: roll or pitch is wrong", above(0)});
    visit(o.ground_height_warning,
          Field{"ground_height_warning", "m", "between two lidars' ground planes: z is wrong", above(0)});
    visit(o.near_share_warning,
          Field{"near_share_warning", "",
                "of the points that another lidar should see, those that it sees within 0.3 m", between(0, 1)});
    visit(o.pose_offset_warning,
          Field{"pose_offset_warning", "m", "by registration to the first lidar: a stem is seen twice", above(0)});
    visit(o.pose_offset_not_fit, Field{"pose_offset_not_fit", "m", "the same: wider than most stems", above(0)});
    visit(o.pose_angle_warning_deg,
          Field{"pose_angle_warning_deg", "deg", "by registration to the first lidar: 17 cm at 10 m", above(0)});
    visit(o.pose_angle_not_fit_deg, Field{"pose_angle_not_fit_deg", "deg", "the same: half a metre at 10 m", above(0)});
  }
};
}  // namespace scanloom
