/** Whether an estimate can be relied on, and what is done where it cannot. */
#pragma once
#include "estimation/slam/internal/DeadReckoning.h"
#include "estimation/slam/internal/SlamSettings.h"
#include "estimation/slam/internal/TrackerState.h"
#include "estimation/slam/internal/TrackingSteps.h"

#include <optional>

namespace scanloom
{
/** A scan whose pose was estimated, as it goes on from there. */
struct Continued
{
  BodyEstimate body;               // as estimated, or where a new window begins
  GatedRegistration registration;  // as it was, or by which the body was found again
  TrustHistory trust;
  Relocalisation relocalisation;
  std::optional<Timestamp> resting_since;
  Assessment assessment{};
  bool recovered = false;   // found again: the pose does not continue the previous one
  bool begins_map = false;  // with this scan: lost for so long that the local map is of no use any more
  StageRuns times{};
};

class HealthMonitor
{
 public:
  explicit HealthMonitor(const SlamSettings&);

  /** Compares a registration with the prediction before it joins the smoother. */
  GatedRegistration gated(Timed<RegistrationResult>, const PoseGuess& predicted, const TrackerState& before) const;

  /**
   * Searches the body in what the scan sees where it is lost and the lidar does not contradict that; accepts the lidar
   * where the IMU has carried the estimate away from it; leaves a body that is lost for good where it was `before`.
   */
  Continued assess(const TrackerState& before, const DeskewedScan&, const GatedRegistration&, const Measurement&,
                   const BodyEstimate&) const;

 private:
  Continued assessed(Continued, const DeskewedScan&, bool map_is_empty) const;
  Continued recovered(Continued, const TrackerState& before, const DeskewedScan&) const;
  Continued accordingToLidar(Continued, const TrackerState& before, Timestamp) const;
  Continued begunAgainAt(const FoundBody&, Continued, const LastGood&) const;
  Continued withoutMap(Continued, const TrackerState& before, const DeskewedScan&) const;
  BodyEstimate resting(const BodyEstimate&, const Attitude&, const TrackerState& before, Duration rest) const;
  SmootherWindow begun(const NavEstimate&, const MountedImu&, const Rigid& map_T_local, const Matrix6d& before) const;

  TrustOptions trust_;
  SmootherOptions smoother_;
  ScanRegistrationOptions registration_;
};
}  // namespace scanloom
