/** Whether an estimate can be relied on, and what is done where it cannot. */
#pragma once
#include "base/core/StageTimes.h"
#include "estimation/slam/StateEstimate.h"
#include "estimation/slam/internal/DeadReckoning.h"
#include "estimation/slam/internal/SlamSettings.h"
#include "estimation/slam/internal/TrackerState.h"

#include <vector>

namespace scanloom
{
struct HealthDecision
{
  bool contradicted = false;  // see Assessment
  bool begins_map = false;    // with this scan: lost for so long that the local map is of no use any more
};

class HealthMonitor
{
 public:
  explicit HealthMonitor(const SlamSettings&);

  /** Sets the estimate's surprise, and whether its registration is trusted, before that joins the smoother. */
  void gate(const PoseGuess& predicted, TrustHistory&, StateEstimate&) const;

  /**
   * Sets the estimate's health. Searches the body in what the scan sees (`views`) where it is lost and the lidar does
   * not contradict that; accepts the lidar where the IMU has carried the estimate away from it; leaves a body that is
   * lost for good where it was in the state before.
   */
  HealthDecision assess(const std::vector<View>& views, const NavState& before, TrackerState&, StateEstimate&,
                        StageTimes&) const;

 private:
  void compareWithRegistration(const StateEstimate&, TrackerState&) const;
  Assessment assessed(TrackerState&, StateEstimate&) const;
  Assessment assessedAndMended(const std::vector<View>&, TrackerState&, StateEstimate&, StageTimes&) const;
  bool recover(const std::vector<View>&, TrackerState&, StateEstimate&, StageTimes&) const;
  void acceptLidar(TrackerState&, StateEstimate&) const;
  void beginAgainAt(const FoundBody&, TrackerState&, StateEstimate&) const;
  bool giveUpMap(const NavState& before, TrackerState&, StateEstimate&) const;
  void comeToRest(const Attitude&, const NavState& before, TrackerState&, StateEstimate&) const;
  void beginWindow(const NavEstimate&, const MountedImu&, const Rigid& map_T_local, TrackerState&) const;

  TrackingOptions tracking_;
  TrustOptions trust_;
  SmootherOptions smoother_;
  ScanRegistrationOptions registration_;
};
}  // namespace scanloom
