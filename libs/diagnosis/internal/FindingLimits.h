/**
 * Limits of the checks of a rig: above `Warning` a finding is a warning, above `NotFit` the rig is not fit for SLAM.
 * Shares are 0 to 1. They are constants: whoever knows better reads the measured value beside the verdict.
 */
#pragma once

namespace scanloom::limits
{
// Delivery of a lidar's packets.
constexpr double kRateTolerance =
    0.02;  // relative error of the packet rate, lost packets included; motors are more exact
constexpr double kLossWarning = 0.001;     // share of lost packets; a wired network loses none
constexpr double kLossNotFit = 0.05;       // share of lost packets; turns have holes of many degrees
constexpr double kGapNotFit = 0.5;         // s: longest gap between packets; registration must bridge the motion in it
constexpr double kDamagedWarning = 0.001;  // share of packets of wrong size or CRC; cable or metadata are at fault
constexpr double kInvalidWarning = 0.02;   // share of blocks that the sensor marks as invalid
constexpr double kInvalidNotFit = 0.5;     // share of invalid blocks; half of the turn is missing
constexpr double kLateNotFit = 0.01;       // share of packets that arrive after deadline_ms and are dropped

// Clocks of the lidars against the first one.
constexpr double kOffsetWarningMs = 2;  // ms: offset to the first lidar's clock; packet sizes and switches explain less
constexpr double kOffsetNotFitMs =
    20;  // ms: offset to the first lidar's clock; at 30 deg/s two lidars see a stem at 10 m 10 cm apart
constexpr double kDriftWarningPpm =
    5;  // ppm: drift against the first lidar's clock, if above three standard deviations; no master corrects the clock
constexpr double kDriftTime = 5;          // s: shortest recording from which a drift is measured
constexpr double kStepMs = 1;             // ms: smallest jump of stamps that counts as a clock step
constexpr double kRotorTolerance = 0.02;  // relative error of the turn rate; motors are more exact

// IMUs, alone and against each other.
constexpr double kGravityWarning =
    0.5;  // m/s2: error of the mean specific force against 9.81; ten times the bias of a good accelerometer
constexpr double kTiltWarningDeg = 15;  // deg: angle of up to the body's z; most forest roads are less steep
constexpr double kTiltNotFitDeg = 45;   // deg: angle of up to the body's z; no machine stands like that
constexpr double kGyroScaleFactor = 2;  // factor between the gyroscope's rotation and gravity's, if beyond three
                                        // standard deviations; only a wrong unit explains it
constexpr double kGyroScaleWarning =
    0.02;  // error of the turn rates of two IMUs against each other; a corner of 90 deg becomes 2 deg wrong
// deg: angle between the turn rates of two IMUs, if beyond four standard deviations; more than the error of a bracket,
// half a metre at 10 m if a lidar's pose is wrong with it
constexpr double kGyroAngleNotFitDeg = 3;
constexpr double kImuLagWarningMs = 20;  // ms: time between two IMUs; at 30 deg/s an attitude error of 0.6 deg
constexpr double kImuGapNotFit = 0.5;    // s: longest gap between samples; the motion during several scans is unknown

// Ground planes that lidars see.
constexpr double kGroundTiltWarningDeg =
    15;  // deg: angle of the ground plane's normal to the body's z; forest roads are less steep
constexpr double kGroundTiltNotFitDeg =
    45;  // deg: angle of the ground plane's normal to the body's z; the pose has a wrong axis
constexpr double kGroundAngleWarningDeg = 3;   // deg: angle between two lidars' ground planes; roll or pitch is wrong
constexpr double kGroundHeightWarning = 0.15;  // m: height between two lidars' ground planes; z is wrong

// What two lidars see in common.
constexpr double kNearShareWarning = 0.5;    // share of the points that another lidar should see and sees within 0.3 m
constexpr double kPoseOffsetWarning = 0.05;  // m: error by registration to the first lidar; drift grows by half
constexpr double kPoseOffsetNotFit =
    0.25;  // m: error by registration to the first lidar; more than the width of most stems
constexpr double kPoseAngleWarningDeg = 0.3;  // deg: error by registration to the first lidar; drift doubles
constexpr double kPoseAngleNotFitDeg = 3;     // deg: error by registration to the first lidar; half a metre at 10 m
}  // namespace scanloom::limits
