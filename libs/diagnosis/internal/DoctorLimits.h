/** Limits of `scanloom doctor`: `_warning` and `_not_fit` belong to the verdicts of that name. */
#pragma once
#include "base/core/Field.h"
#include "diagnosis/internal/GroundFinding.h"

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
          Field{"rate_tolerance", "", "relative error of the packet rate, lost packets included; motors are more exact",
                between(0, 1)});
    visit(o.loss_warning,
          Field{"loss_warning", "", "share of lost packets; a wired network loses none", between(0, 1)});
    visit(o.loss_not_fit,
          Field{"loss_not_fit", "", "share of lost packets; turns have holes of many degrees", between(0, 1)});
    visit(o.gap_not_fit, Field{"gap_not_fit", "s",
                               "longest gap between packets; registration must bridge the motion in it", above(0)});
    visit(o.damaged_warning,
          Field{"damaged_warning", "", "share of packets of wrong size or CRC; cable or metadata are at fault",
                between(0, 1)});
    visit(o.invalid_warning,
          Field{"invalid_warning", "", "share of blocks that the sensor marks as invalid", between(0, 1)});
    visit(o.invalid_not_fit,
          Field{"invalid_not_fit", "", "share of invalid blocks; half of the turn is missing", between(0, 1)});
    visit(o.late_not_fit,
          Field{"late_not_fit", "", "share of packets that arrive after deadline_ms and are dropped", between(0, 1)});
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
          Field{"offset_warning_ms", "ms", "offset to the first lidar's clock; packet sizes and switches explain less",
                above(0)});
    visit(o.offset_not_fit_ms,
          Field{"offset_not_fit_ms", "ms",
                "offset to the first lidar's clock; at 30 deg/s two lidars see a stem at 10 m 10 cm apart", above(0)});
    visit(
        o.drift_warning_ppm,
        Field{"drift_warning_ppm", "ppm",
              "drift against the first lidar's clock, if above three standard deviations; no master corrects the clock",
              above(0)});
    visit(o.drift_time, Field{"drift_time", "s", "shortest recording from which a drift is measured", above(0)});
    visit(o.rotor_tolerance,
          Field{"rotor_tolerance", "", "relative error of the turn rate; motors are more exact", between(0, 1)});
    visit(o.step_ms, Field{"step_ms", "ms", "smallest jump of stamps that counts as a clock step", above(0)});
  }
};

struct ImuLimits
{
  double gravity_warning = 0.5;
  double tilt_warning_deg = 15;
  double tilt_not_fit_deg = 45;
  double gyro_scale_factor = 2;
  double gyro_scale_warning = 0.02;
  double gyro_angle_not_fit_deg = 3;
  double imu_lag_warning_ms = 20;
  double imu_gap_not_fit = 0.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.gravity_warning,
          Field{"gravity_warning", "m/s2",
                "error of the mean specific force against 9.81; ten times the bias of a good accelerometer", above(0)});
    visit(o.tilt_warning_deg,
          Field{"tilt_warning_deg", "deg", "angle of up to the body's z; most forest roads are less steep", above(0)});
    visit(o.tilt_not_fit_deg,
          Field{"tilt_not_fit_deg", "deg", "angle of up to the body's z; no machine stands like that", above(0)});
    visit(
        o.gyro_scale_factor,
        Field{
            "gyro_scale_factor", "",
            "factor between the gyroscope's rotation and gravity's, if beyond three standard deviations; only a wrong "
            "unit explains it",
            above(1)});
    visit(o.gyro_scale_warning,
          Field{"gyro_scale_warning", "",
                "error of the turn rates of two IMUs against each other; a corner of 90 deg becomes 2 deg wrong",
                above(0)});
    visit(o.gyro_angle_not_fit_deg,
          Field{"gyro_angle_not_fit_deg", "deg",
                "angle between the turn rates of two IMUs, above four standard deviations; more than the error of a "
                "bracket, half a metre at 10 m if a lidar's pose is wrong with it",
                above(0)});
    visit(o.imu_lag_warning_ms, Field{"imu_lag_warning_ms", "ms",
                                      "time between two IMUs; at 30 deg/s an attitude error of 0.6 deg", above(0)});
    visit(o.imu_gap_not_fit,
          Field{"imu_gap_not_fit", "s", "longest gap between samples; the motion during several scans is unknown",
                above(0)});
  }
};

}  // namespace scanloom
