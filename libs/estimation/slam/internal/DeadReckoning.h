#pragma once
#include "base/core/Time.h"

#include <Eigen/Geometry>

namespace scanloom
{
/** How the IMU has changed the velocity of a body since its last pose that was not LOST. */
struct DeadReckoning
{
  Eigen::Vector3d gained;  // m/s, in the map
  Duration within;
};

/** Whether a machine can have gained that: less than from full speed forwards to full speed backwards. */
bool isPossible(const DeadReckoning&);

/**
 * Mean specific force since then, in m/s2, turned into the map by the attitudes of the IMU. It points up; it leans by
 * the acceleration of the drive, and where these attitudes are wrong.
 */
Eigen::Vector3d meanForce(const DeadReckoning&);

struct Attitude
{
  Eigen::Quaterniond map_R_body;
  double tilt_sigma = 0;  // rad, by which the tilt is less certain than it was
};

/**
 * An impossible gain comes from a wrong tilt, along which gravity has accelerated the body. Returns the attitude
 * without that error; after a possible gain, the attitude as it is.
 */
Attitude levelledByMeanForce(const Eigen::Quaterniond& map_R_body, const DeadReckoning&);
}  // namespace scanloom
