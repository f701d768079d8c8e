#include "estimation/slam/internal/DeadReckoning.h"

#include "estimation/imu/NavState.h"
#include "estimation/ndt/FittedConstants.h"

namespace scanloom
{
bool isPossible(const DeadReckoning& motion) { return motion.gained.norm() < 2 * fitted::kMachineSpeed; }

Eigen::Vector3d meanForce(const DeadReckoning& motion)
{
  return motion.gained / seconds(motion.within) - gravityInMap();
}

Attitude levelledByMeanForce(const Eigen::Quaterniond& map_R_body, const DeadReckoning& motion)
{
  if (isPossible(motion)) return {map_R_body};
  const Eigen::Quaterniond correction = rotationBetween(meanForce(motion), Eigen::Vector3d::UnitZ());
  return {correction * map_R_body, 2 * fitted::kMachineSpeed / seconds(motion.within) / kGravity};
}
}  // namespace scanloom
