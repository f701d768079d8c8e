/**
 * Limits of the checks of a rig: above `Warning` a finding is a warning, above `NotFit` the rig is not fit for SLAM.
 * Shares have the unit 1; deviations are standard deviations. Whoever knows better than these constants reads the
 * measured value beside the verdict.
 */
#pragma once

namespace scanloom::limits
{
// clang-format off
// Delivery of a lidar's packets
constexpr double kRateTolerance         = 0.02;  // 1     of the packet rate, lost packets included; motors are better
constexpr double kLossWarning           = 0.001; // 1     of the packets; a wired network loses none
constexpr double kLossNotFit            = 0.05;  // 1     of the packets; turns have holes of many degrees
constexpr double kGapNotFit             = 0.5;   // s     longest gap between packets; registration must bridge it
constexpr double kDamagedWarning        = 0.001; // 1     packets of wrong size or CRC; cable or metadata are at fault
constexpr double kInvalidWarning        = 0.02;  // 1     blocks that the sensor marks as invalid
constexpr double kInvalidNotFit         = 0.5;   // 1     invalid blocks; half of the turn is missing
constexpr double kLateNotFit            = 0.01;  // 1     packets that arrive after deadline_ms and are dropped

// Clocks of the lidars against the first one
constexpr double kOffsetWarningMs       = 2;     // ms    offset; packet sizes and switches explain less
constexpr double kOffsetNotFitMs        = 20;    // ms    offset; at 30 deg/s two lidars see a stem at 10 m 10 cm apart
constexpr double kDriftWarningPpm       = 5;     // ppm   drift, beyond three deviations; no master corrects the clock
constexpr double kDriftTime             = 5;     // s     shortest recording from which a drift is measured
constexpr double kStepMs                = 1;     // ms    smallest jump of stamps that counts as a clock step
constexpr double kRotorTolerance        = 0.02;  // 1     error of the turn rate; motors are better

// IMUs, alone and against each other
constexpr double kGravityWarning        = 0.5;   // m/s2  mean force against 9.81; ten times a good accelerometer's bias
constexpr double kTiltWarningDeg        = 15;    // deg   up to the body's z; most forest roads are less steep
constexpr double kTiltNotFitDeg         = 45;    // deg   up to the body's z; no machine stands like that
constexpr double kGyroScaleFactor       = 2;     // 1     turn by gyroscope over gravity's, beyond three deviations
constexpr double kGyroScaleWarning      = 0.02;  // 1     turn rates of two IMUs; a corner of 90 deg becomes 2 deg wrong
constexpr double kGyroAngleNotFitDeg    = 3;     // deg   between two IMUs' rates, beyond four deviations
constexpr double kImuLagWarningMs       = 20;    // ms    between two IMUs; at 30 deg/s an attitude error of 0.6 deg
constexpr double kImuGapNotFit          = 0.5;   // s     longest gap between samples; longer than several scans

// Ground planes that lidars see
constexpr double kGroundTiltWarningDeg  = 15;    // deg   of the normal to the body's z; forest roads are less steep
constexpr double kGroundTiltNotFitDeg   = 45;    // deg   of the normal to the body's z; the pose has a wrong axis
constexpr double kGroundAngleWarningDeg = 3;     // deg   between two lidars' planes; roll or pitch is wrong
constexpr double kGroundHeightWarning   = 0.15;  // m     between two lidars' planes; z is wrong

// What two lidars see in common
constexpr double kNearShareWarning      = 0.5;   // 1     of the points that another should see, and sees within 0.3 m
constexpr double kPoseOffsetWarning     = 0.05;  // m     by registration to the first lidar; drift grows by half
constexpr double kPoseOffsetNotFit      = 0.25;  // m     by registration to the first lidar; wider than most stems
constexpr double kPoseAngleWarningDeg   = 0.3;   // deg   by registration to the first lidar; drift doubles
constexpr double kPoseAngleNotFitDeg    = 3;     // deg   by registration to the first lidar; half a metre at 10 m
// clang-format on
}  // namespace scanloom::limits
