/** Which way is up, and how strong gravity is, by an accelerometer. */
#pragma once
#include "core/ImuSample.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Mean specific force (m/s2 if the samples are) in the IMU's frame: at rest it points up; of a machine that drives,
 * what it adds averages out. None without samples.
 */
std::optional<Eigen::Vector3d> meanForce(const std::vector<ImuSample>&);

enum class ForceUnit
{
  MetresPerSecondSquared,
  StandardGravity,  // about 1
  MilliGravity,     // about 1000; cm/s2 look the same
  GravityTakenOut,  // about 0: what phones call linear acceleration
  Unclear,
};
ForceUnit forceUnitOf(double magnitude);

/** How to mend it; empty for m/s2. */
std::string adviceFor(ForceUnit);

/** "+y" */
std::string nearestAxis(const Eigen::Vector3d&);

/** Degrees between two directions, 0 to 180. */
double degreesBetween(const Eigen::Vector3d&, const Eigen::Vector3d&);

/** How to turn a direction upwards, for a person: "90 deg about x", "37 deg about the axis (0.50 0.87 0.00)". */
std::string turnUpwards(const Eigen::Vector3d& up_in_body);
}  // namespace scanloom
