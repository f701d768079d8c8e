#pragma once
#include "core/Time.h"

#include <Eigen/Geometry>

namespace scanloom
{
/** How the IMU alone has moved a body since it was lost. */
struct LostMotion
{
  Eigen::Vector3d gained;  // velocity, m/s, in the map
  Duration within;
};

/** Below 3 m/s: no machine gains more in the seconds until its map is given up. */
bool isPossible(const LostMotion&);

/**
 * Mean specific force (m/s2) in the map by the attitude of the IMU, without what the body gained before it was lost. It
 * points up but for the acceleration of the drive and for the error of the attitude.
 */
Eigen::Vector3d meanForce(const LostMotion&);

struct Attitude
{
  Eigen::Quaterniond map_R_body;
  double tilt_sigma = 0;  // rad, by which the tilt is less certain than it was
};

/** A velocity that is not possible comes from gravity along an error of the tilt: the attitude without that error. */
Attitude levelled(const Eigen::Quaterniond& map_R_body, const LostMotion&);
}  // namespace scanloom
