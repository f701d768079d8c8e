#include "mrpt/maps/internal/PoseCovariance.h"

#include "base/core/Decompositions.h"

#include <cmath>

namespace scanloom
{
namespace
{
/** A rotation w about the body's axes changes the angles by the inverse of the kinematics of R = Rz(yaw) Ry(pitch)
 * Rx(roll). */
Matrix6d anglesByStep(const Rigid& map_T_body)
{
  const Eigen::Vector3d angles = map_T_body.yawPitchRoll();
  const double cos_pitch = std::cos(angles[1]), sin_roll = std::sin(angles[2]), cos_roll = std::cos(angles[2]);
  const double tan_pitch = std::tan(angles[1]);
  Matrix6d change = Matrix6d::Zero();
  change.topLeftCorner<3, 3>() = map_T_body.rotation.toRotationMatrix();
  change.bottomRightCorner<3, 3>() << 0, sin_roll / cos_pitch, cos_roll / cos_pitch,  //
      0, cos_roll, -sin_roll,                                                         //
      1, sin_roll * tan_pitch, cos_roll * tan_pitch;
  return change;
}
}  // namespace

Matrix6d ofAngles(const Rigid& map_T_body, const Matrix6d& along_body)
{
  const Matrix6d change = anglesByStep(map_T_body);
  return change * along_body * change.transpose();
}

Matrix6d alongBody(const Rigid& map_T_body, const Matrix6d& of_angles)
{
  const Matrix6d back = inverse(anglesByStep(map_T_body));
  return back * of_angles * back.transpose();
}
}  // namespace scanloom
