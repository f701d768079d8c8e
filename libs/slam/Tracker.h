/** Follows the machine from scan to scan (paper, section 2.2): Tracker::step() is the algorithm on one page. */
#pragma once
#include "core/MountedLidar.h"
#include "core/StageTimes.h"
#include "graph/FixedLagSmoother.h"
#include "ndt/View.h"
#include "preprocessing/Crop.h"
#include "slam/Assessment.h"
#include "slam/AttitudeDoubt.h"
#include "slam/LocalMap.h"
#include "slam/Recovery.h"
#include "slam/SlamSettings.h"
#include "slam/WindowStart.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** What is remembered from one scan to the next. */
struct TrackerState
{
  FixedLagSmoother smoother;
  LocalMap local_map;                    // rigid, in a frame of its own
  Rigid local_T_anchor;                  // the body at the smoother's anchor
  std::optional<Rigid> last_registered;  // local_T_body
  Trajectory motion_since_last;          // body poses from the state before the newest up to it
  TrustHistory trust;
  Recovery recovery;
  AttitudeDoubt attitude_doubt;
  std::optional<Timestamp> resting_since;  // lost, and no longer carried by the IMU

  Rigid map_T_local() const;
};

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

  TrackerState begin(const NavEstimate&, const PlacedImu&) const;

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

  FixedLagSmoother windowFrom(const NavEstimate&, const PlacedImu&) const;
  Prediction predict(const std::vector<ImuSample>&, TrackerState&, StageTimes&) const;
  Seen preprocess(Scan, const NavState& before, const std::vector<ImuSample>&, const TrackerState&, StageTimes&) const;
  void locate(const Seen&, const Prediction&, TrackerState&, StateEstimate&, StageTimes&) const;
  RegistrationResult registerScan(const std::vector<View>&, const PoseGuess&, const TrackerState&, StageTimes&) const;
  void addRegistration(const PoseGuess& predicted, TrackerState&, StateEstimate&) const;
  void smooth(const NavState& before, const std::vector<ImuSample>&, const Prediction&, TrackerState&, StateEstimate&,
              StageTimes&) const;
  void compareWithRegistration(const StateEstimate&, TrackerState&) const;
  bool judgeAndRecover(const Seen&, TrackerState&, StateEstimate&, StageTimes&) const;
  Assessment judge(TrackerState&, StateEstimate&) const;
  bool recover(const std::vector<View>&, TrackerState&, StateEstimate&, StageTimes&) const;
  void believeLidar(TrackerState&, StateEstimate&) const;
  void beginAgainAt(const FoundBody&, TrackerState&, StateEstimate&) const;
  void comeToRest(const NavState& before, TrackerState&, StateEstimate&) const;
  void anchorAt(const Rigid& local_T_body, TrackerState&) const;
  Matrix6d driftOf(const TrackerState&, const StateEstimate&) const;
  bool isLostForGood(const TrackerState&, const StateEstimate&) const;
  void updateMap(const Seen&, bool contradicted, TrackerState&, StateEstimate&, StageTimes&) const;
  void addKeyframe(const Seen&, TrackerState&, StateEstimate&) const;

  SlamSettings settings_;
  ScanRegistrationOptions limited_effort_;   // for a lost body
  std::vector<Eigen::Vector3d> viewpoints_;  // of the lidars in the body frame; empty: stems stay where they are seen
};
}  // namespace scanloom
