/** Pose and clock of a lidar on the body, and what it sees with them. */
#pragma once
#include "base/core/StampedPose.h"
#include "calibration/internal/LidarScans.h"
#include "estimation/ndt/View.h"

#include <optional>

namespace scanloom
{
struct Extrinsics
{
  Rigid body_T_sensor;
  double clock_offset = 0;  // s: its stamps are so much later than the reference's for the same instant
};

/** How views show stems (forestCorrections). */
enum class Stems
{
  AsSeen,  // best where both lidars see the same sides: moved by few points each, they put a lidar 6 mm off, not 3 mm
  OnAxes,  // where one sees the side that the other does not: as seen they put it 30 mm off
};

/**
 * The scan's points as they would have been seen from the body at the instant `at`, in its frame. None if the
 * trajectory does not cover the scan and the instant, or has a gap of more than 0.5 s there.
 */
std::optional<View> viewFrom(const LidarScan&, const Extrinsics&, const Trajectory&, Timestamp at,
                             Stems = Stems::AsSeen);
}  // namespace scanloom
