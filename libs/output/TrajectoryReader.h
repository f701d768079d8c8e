/** Trajectories of other programs: EuRoC's csv and KITTI's rows, beside TUM. */
#pragma once
#include "output/Trajectory.h"

namespace scanloom
{
/** EuRoC: integer ns, position, quaternion with w first, further columns (velocity, biases) skipped. Throws as
 * readTum().
 */
Trajectory readEuroc(const std::filesystem::path&);

/** KITTI odometry: twelve numbers a line, and as many stamps in s in `times`. Throws as readTum(). */
Trajectory readKitti(const std::filesystem::path& poses, const std::filesystem::path& times);

/** Whether the first line with data begins with integer nanoseconds and a comma. */
bool isEuroc(const std::filesystem::path&);

/**
 * Whichever the first line with data shows. KITTI's stamps are looked for beside it, in <name>_times.txt or times.txt.
 */
Trajectory readTrajectory(const std::filesystem::path&);
}  // namespace scanloom
