#include "estimation/slam/internal/DeadReckoning.h"

#include "estimation/imu/NavState.h"

namespace scanloom
{
namespace
{
constexpr double kMostGained = 2 * kMachineSpeed;
}

bool isPossible(const DeadReckoning& motion) { return motion.gained.norm() < kMostGained; }

Eigen::Vector3d meanForce(const DeadReckoning& motion)
{
  return motion.gained / seconds(motion.within) - gravityInMap();
}

Attitude levelledByMeanForce(const Eigen::Quaterniond& map_R_body, const DeadReckoning& motion)
{
  if (isPossible(motion)) return {map_R_body};
  const Eigen::Quaterniond correction = rotationBetween(meanForce(motion), Eigen::Vector3d::UnitZ());
  return {correction * map_R_body, kMostGained / seconds(motion.within) / kGravity};
}
}  // namespace scanloom
