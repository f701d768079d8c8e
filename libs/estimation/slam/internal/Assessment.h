/** Whether the pose of a scan can be trusted, assessed by that scan and the ones before it. */
#pragma once
#include "estimation/slam/StateEstimate.h"
#include "estimation/slam/internal/DivergenceDetector.h"
#include "estimation/slam/internal/InnovationMonitor.h"
#include "estimation/slam/internal/LidarTrack.h"

#include <optional>

namespace scanloom
{
struct TrustOptions
{
  double contradiction = 12.0;  // sigma: LOST if registrations and IMU predictions are farther apart than this in the
                                // median of ten seconds; 0: never
  double restart_after =
      10.0;  // s: after being LOST for this long a new local map begins at the pose that the IMU predicts
  double lost_after = 2.0;  // s: LOST after this long without a trusted registration
};

/** Results of earlier scans by which the next one is assessed. */
struct TrustHistory
{
  Timestamp last_trusted;
  std::optional<Timestamp> initialising_until;  // none after a start from standstill
  InnovationMonitor contradiction;              // between registrations and IMU
  DivergenceDetector divergence{};              // of estimates from their registrations
  LidarTrack lidar_track{};                     // of the usable ones
  std::optional<Timestamp> lidar_accepted{};    // when the window last began anew at a registration
  bool imu_silent = false;                      // for kImuSilence or longer up to this scan's end
  bool lost = false;                            // at the scan before
};

struct Assessment
{
  Health health = Health::Ok;
  Timestamp last_trusted;     // the scan's stamp if it is trusted
  bool contradicted = false;  // registrations and IMU have contradicted each other for seconds
};

/** `trusted`: the scan is the first keyframe of a local map, which needs no registration, or its registration is. */
Assessment assess(Timestamp, bool trusted, const TrustHistory&, const TrustOptions&);
}  // namespace scanloom
