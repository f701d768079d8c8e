/** Pose and clock of a lidar on the body, and what it sees with them. */
#pragma once
#include "calibration/LidarScans.h"
#include "core/StampedPose.h"
#include "ndt/View.h"

#include <optional>

namespace scanloom
{
struct Mount
{
  Rigid body_T_sensor;
  double clock_offset = 0;  // s: its stamps are so much later than the reference's for the same instant
};

/**
 * The scan's points as they would have been seen from the body at the instant `at`, in its frame. None if the
 * trajectory does not cover the scan and the instant, or has a gap of more than 0.5 s there. The view has no viewpoint:
 * stems stay as they are seen (ndt/ThinBodies.h). Both lidars see them from many places; moved onto their axes, by few
 * points each, they put a lidar 6 mm off instead of 3 mm.
 */
std::optional<View> viewFrom(const LidarScan&, const Mount&, const Trajectory&, Timestamp at);
}  // namespace scanloom
