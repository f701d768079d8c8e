/** What Python keeps of an estimate: without the cloud and the maps, of which 10,000 would fill the memory. */
#pragma once
#include "CloudMemory.h"
#include "estimation/slam/StateEstimate.h"

#include <memory>

namespace scanloom
{
enum class KeptClouds
{
  None,
  All,
};

/** The members are those of StateEstimate. */
struct Pose
{
  Timestamp stamp;
  Rigid map_T_body;
  Matrix6d covariance, since_start;
  Eigen::Vector3d velocity;
  Health health = Health::Ok;
  bool trusted = false, recovered = false, map_restarted = false, in_map = false;
  bool scan_complete = true, imu_complete = true;
  std::shared_ptr<CloudMemory> cloud;  // null: it was not kept
};

inline Pose poseOf(const StateEstimate& e, KeptClouds kept)
{
  return {e.stamp,
          e.map_T_body,
          e.covariance,
          e.since_start,
          e.velocity,
          e.health,
          e.trusted,
          e.recovered,
          e.map_restarted,
          e.in_map,
          e.scan_complete,
          e.imu_complete,
          kept == KeptClouds::All ? std::make_shared<CloudMemory>(e.cloud) : nullptr};
}
}  // namespace scanloom
