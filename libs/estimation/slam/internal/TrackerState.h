/** What is remembered from one scan to the next. */
#pragma once
#include "estimation/graph/FixedLagSmoother.h"
#include "estimation/slam/internal/Assessment.h"
#include "estimation/slam/internal/LocalMap.h"
#include "estimation/slam/internal/MeasurementCorrelation.h"
#include "estimation/slam/internal/Relocalisation.h"
#include "estimation/slam/internal/SharedAttitudeNoise.h"
#include "estimation/slam/internal/SmootherReset.h"

#include <optional>

namespace scanloom
{
/** The last pose that was not LOST. */
struct LastGood
{
  Timestamp stamp;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, in the map
  Matrix6d since_start = Matrix6d::Zero();             // as TrackerState::before_window; without scaleError()
};

struct TrackerState
{
  FixedLagSmoother smoother;
  LocalMap local_map;                  // rigid, in a frame of its own
  Rigid local_T_anchor{};              // the body at the smoother's anchor
  Rigid map_T_local_without_anchor{};  // until a keyframe is the anchor
  Trajectory motion_since_last{};      // body poses from the state before the newest up to it
  TrustHistory trust{};
  Relocalisation relocalisation{};
  MeasurementCorrelation measurement_correlation{};
  SharedAttitudeNoise shared_attitude_noise{};
  std::optional<Timestamp> resting_since{};  // lost, and no longer carried by the IMU
  int scans_seen = 0;  // in a row that have points: the first after a silence may be a single packet
  LastGood last_good{};
  // Covariance relative to the first pose, of what erred before the smoother's window began; as of steps (m, rad) of a
  // body at the map's origin:
  Matrix6d before_window = Matrix6d::Zero();

  Rigid map_T_local() const;
  NavEstimate newest() const { return {smoother.newest(), smoother.newestCovariance()}; }
  MountedImu imu() const { return {smoother.body_T_imu(), smoother.noise()}; }

  /** Registrations from now on are relative to the newest body, which is there in the local map. */
  void anchorAt(const Rigid& local_T_body);
};

FixedLagSmoother windowFrom(const NavEstimate& start, const MountedImu&, const SmootherOptions&);

Eigen::Vector3d upInBody(const Rigid& map_T_body);
}  // namespace scanloom
