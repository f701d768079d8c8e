/** The first state: attitude, biases and velocity. */
#pragma once
#include "estimation/imu/ImuInitialisation.h"
#include "estimation/slam/internal/Tracker.h"
#include "estimation/slam/internal/WaitingScans.h"

#include <optional>

namespace scanloom
{
/**
 * At the start of the first scan; none until the IMU covers the time that a standstill takes, or the input has ended.
 * At rest, attitude and biases come from the IMU. Otherwise the attitude is that of the mean specific force, and the
 * velocity comes from a trial: the first scans are tracked as if the machine had started from rest. Without an IMU
 * the body is taken for level, and the velocity comes from the trial. Throws what requireGravity() does.
 */
std::optional<TrackerState> startUp(const WaitingScans&, const ImuBuffer&, const MountedImu&, const StandstillOptions&,
                                    const Tracker&);
}  // namespace scanloom
