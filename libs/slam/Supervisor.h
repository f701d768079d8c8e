/** Whether an estimate is to be believed, and what is done where it is not. */
#pragma once
#include "core/StageTimes.h"
#include "slam/LostMotion.h"
#include "slam/SlamSettings.h"
#include "slam/StateEstimate.h"
#include "slam/TrackerState.h"

#include <vector>

namespace scanloom
{
class Supervisor
{
 public:
  struct Verdict
  {
    bool contradicted = false;  // see Assessment
    bool begins_map = false;    // with this scan: lost for so long that the local map is of no use any more
  };

  explicit Supervisor(const SlamSettings&);

  /** Sets the estimate's surprise, and whether its registration is trusted, before that joins the smoother. */
  void rate(const PoseGuess& predicted, TrustHistory&, StateEstimate&) const;

  /**
   * Sets the estimate's health. Searches the body in what the scan sees (`views`) where it is lost and the lidar does
   * not contradict that; believes the lidar where the IMU has carried the estimate away from it; leaves a body that is
   * lost for good where it was in the state before.
   */
  Verdict judge(const std::vector<View>& views, const NavState& before, TrackerState&, StateEstimate&,
                StageTimes&) const;

 private:
  void compareWithRegistration(const StateEstimate&, TrackerState&) const;
  Assessment assessed(TrackerState&, StateEstimate&) const;
  Assessment assessedAndMended(const std::vector<View>&, TrackerState&, StateEstimate&, StageTimes&) const;
  bool recover(const std::vector<View>&, TrackerState&, StateEstimate&, StageTimes&) const;
  void believeLidar(TrackerState&, StateEstimate&) const;
  void beginAgainAt(const FoundBody&, TrackerState&, StateEstimate&) const;
  bool giveUpMap(const NavState& before, TrackerState&, StateEstimate&) const;
  void comeToRest(const Attitude&, const NavState& before, TrackerState&, StateEstimate&) const;
  void beginWindow(const NavEstimate&, const PlacedImu&, const Rigid& map_T_local, TrackerState&) const;

  TrackingOptions tracking_;
  TrustOptions trust_;
  SmootherOptions smoother_;
  ScanRegistrationOptions registration_;
};
}  // namespace scanloom
