/** Follows the machine from scan to scan (paper, section 2.2): Tracker::step() is the algorithm on one page. */
#pragma once
#include "base/core/MountedLidar.h"
#include "base/core/StageTimes.h"
#include "estimation/slam/PriorMap.h"
#include "estimation/slam/internal/HealthMonitor.h"
#include "estimation/slam/internal/SlamSettings.h"
#include "estimation/slam/internal/TrackerState.h"
#include "estimation/slam/internal/TrackingSteps.h"
#include "input/batching/Scan.h"

#include <memory>
#include <vector>

namespace scanloom
{
struct TrackedScan
{
  TrackerState state;
  StateEstimate estimate;
  StageRuns times;
};

/** Where a drive is found in the map of an earlier one. */
struct MapEntry
{
  std::shared_ptr<const PriorMap> map;
  Rigid map_T_drive;
  Matrix6d covariance;  // of the body's pose in the map, tangent of boxPlus
};

class Tracker
{
 public:
  /** `lidars` by sensor id. */
  Tracker(const SlamSettings&, const std::vector<MountedLidar>& lidars);

  TrackerState begin(const NavEstimate&, const MountedImu&) const;

  /** The state after a scan without the machine's points. The samples are the IMU's from the newest state to the scan's
   * end (ImuBuffer::between). */
  TrackedScan step(TrackerState, Scan, const std::vector<ImuSample>&) const;

  /** The same state in the frame of the map; what was registered before is in another one and forgotten. */
  TrackerState enterMap(const TrackerState&, const MapEntry&) const;

  /** The same state, as another IMU of the same body continues it. */
  TrackerState changeImu(TrackerState, const ImuChange&) const;

 private:
  Prediction predict(const SmootherWindow&, const std::vector<ImuSample>&) const;
  DeskewedScan deskewToEnd(Scan, const TrackerState&, const std::vector<ImuSample>&) const;
  GatedRegistration registerToMap(const TrackerState&, const DeskewedScan&, const Prediction&) const;
  Timed<RegistrationResult> registerScan(const TrackerState&, const std::vector<View>&, const PoseGuess&) const;
  Measurement weigh(const GatedRegistration&, const TrackerState&, const Prediction&, Timestamp) const;
  Timed<BodyEstimate> smooth(const Measurement&, const Prediction&) const;
  UpdatedMap updateMap(LocalMap, const DeskewedScan&, const Continued&) const;
  UpdatedMap withKeyframe(UpdatedMap, const DeskewedScan&, const Rigid& local_T_body) const;
  KeyframePose alignFinely(const UpdatedMap&, const std::vector<View>&, const Rigid& local_T_body) const;

  SlamSettings settings_;
  HealthMonitor health_monitor_;
  std::vector<Rigid> body_T_lidar_;
  CellCorrections corrections_;
};
}  // namespace scanloom
