/** Direction and strength of gravity by an accelerometer. */
#pragma once
#include "base/core/ImuSample.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Mean specific force in the IMU's frame, in the unit of the samples. It points up: accelerations of a drive average
 * out. None without samples.
 */
std::optional<Eigen::Vector3d> meanForce(const std::vector<ImuSample>&);

enum class ForceUnit
{
  MetresPerSecondSquared,
  StandardGravity,  // about 1
  MilliGravity,     // about 1000; cm/s2 look the same
  GravityTakenOut,  // about 0: phones call it linear acceleration
  Unclear,
};
ForceUnit forceUnitOf(double magnitude);

/** How to correct the samples; empty for m/s2. */
std::string adviceFor(ForceUnit);

/** "+y" */
std::string nearestAxis(const Eigen::Vector3d&);

/** Degrees between two directions, 0 to 180. */
double degreesBetween(const Eigen::Vector3d&, const Eigen::Vector3d&);

/** The rotation that turns a direction upwards, as text: "90 deg about x", "37 deg about the axis (0.50 0.87 0.00)". */
std::string turnUpwards(const Eigen::Vector3d& up_in_body);
}  // namespace scanloom
