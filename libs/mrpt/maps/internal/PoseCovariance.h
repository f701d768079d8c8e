/** Covariances of poses as MRPT has them: of x, y, z, yaw, pitch, roll in the map's frame. */
#pragma once
#include "base/core/Rigid.h"

namespace scanloom
{
/** `along_body`: of boxMinus(truth, map_T_body). */
Matrix6d ofAngles(const Rigid& map_T_body, const Matrix6d& along_body);

/** The inverse of ofAngles(). */
Matrix6d alongBody(const Rigid& map_T_body, const Matrix6d& of_angles);
}  // namespace scanloom
