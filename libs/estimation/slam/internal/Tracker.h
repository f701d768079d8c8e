/** Follows the machine from scan to scan (paper, section 2.2): Tracker::step() is the algorithm on one page. */
#pragma once
#include "base/core/MountedLidar.h"
#include "base/core/StageTimes.h"
#include "estimation/ndt/View.h"
#include "estimation/slam/internal/HealthMonitor.h"
#include "estimation/slam/internal/SlamSettings.h"
#include "estimation/slam/internal/TrackerState.h"

#include <vector>

namespace scanloom
{
struct TrackedScan
{
  TrackerState state;
  StateEstimate estimate;
};

class Tracker
{
 public:
  /** `lidars` by sensor id. */
  Tracker(const SlamSettings&, const std::vector<MountedLidar>& lidars);

  TrackerState begin(const NavEstimate&, const MountedImu&) const;

  /** The state after a scan without the machine's points. The samples are the IMU's from the newest state to the scan's
   * end (ImuBuffer::between). */
  TrackedScan step(TrackerState, Scan, const std::vector<ImuSample>&, StageTimes&) const;

  /** The same state, as another IMU of the same body continues it. */
  TrackerState changeImu(TrackerState, const ImuChange&) const;

 private:
  struct Prediction
  {
    Rigid map_T_body;
    Matrix6d covariance;  // see FixedLagSmoother::newestBodyCovariance()
  };
  struct Seen
  {
    PointCloud cloud;  // in the body frame at the scan's end
    std::vector<View> views;
  };

  Prediction predict(const std::vector<ImuSample>&, TrackerState&, StageTimes&) const;
  Seen preprocess(Scan, const NavState& before, const std::vector<ImuSample>&, const TrackerState&, StageTimes&) const;
  void locate(const Seen&, const Prediction&, TrackerState&, StateEstimate&, StageTimes&) const;
  RegistrationResult registerScan(const std::vector<View>&, const PoseGuess&, const TrackerState&, StageTimes&) const;
  void addRegistration(const PoseGuess& predicted, TrackerState&, StateEstimate&) const;
  void smooth(const NavState& before, const std::vector<ImuSample>&, const Prediction&, TrackerState&, StateEstimate&,
              StageTimes&) const;
  void updateMap(const Seen&, const HealthDecision&, TrackerState&, StateEstimate&, StageTimes&) const;
  void addKeyframe(const Seen&, TrackerState&, StateEstimate&) const;

  SlamSettings settings_;
  HealthMonitor health_monitor_;
  std::vector<Rigid> body_T_lidar_;  // empty: points are taken as they are seen
};
}  // namespace scanloom
