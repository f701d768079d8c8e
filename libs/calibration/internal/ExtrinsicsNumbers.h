/** Pose, clock and their standard deviations, as text and as JSON: alike for lidars and the IMU. */
#pragma once
#include "calibration/internal/ExtrinsicsCovariance.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** The standard deviation of each number, in m, deg and s. */
Vector7d deviationsOf(const Matrix7d& covariance);

/** "x y z 1.4954 ... m (+- ...), yaw pitch roll ... deg (+- ... about z y x)" */
std::string poseInWords(const Extrinsics&, const Matrix7d& covariance);

/** A line about each direction. */
std::string openInWords(const std::string& sensor, const std::vector<OpenDirection>&);

/** Poses as in extrinsics files; standard deviations in m, deg and s, the covariance in m, rad and s. */
nlohmann::json numbersOf(const Extrinsics&, const Matrix7d& covariance, const std::vector<OpenDirection>&);
}  // namespace scanloom
