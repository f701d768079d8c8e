/** The window of states that are estimated together, and where the local map is in their frame. */
#pragma once
#include "estimation/graph/FixedLagSmoother.h"
#include "estimation/slam/internal/MeasurementCorrelation.h"
#include "estimation/slam/internal/SmootherReset.h"

namespace scanloom
{
struct SmootherWindow
{
  FixedLagSmoother smoother;
  bool imu_is_assumed = false;           // MountedImu::assumed
  Rigid map_T_local_without_anchor{};    // until a keyframe is the anchor
  Rigid local_T_anchor{};                // the body at the smoother's anchor
  MeasurementCorrelation correlation{};  // of the registrations in it
  // Covariance relative to the first pose, of what erred before the window began; as of steps (m, rad) of a body at the
  // map's origin:
  Matrix6d before = Matrix6d::Zero();

  Rigid map_T_local() const;
  NavEstimate newest() const { return {smoother.newest(), smoother.newestCovariance()}; }
  MountedImu imu() const { return {smoother.body_T_imu(), smoother.noise(), imu_is_assumed}; }

  /** Registrations from now on are relative to the newest body, which is there in the local map. */
  void anchorAt(const Rigid& local_T_body);
};

SmootherWindow windowFrom(const NavEstimate& start, const MountedImu&, const SmootherOptions&);
}  // namespace scanloom
