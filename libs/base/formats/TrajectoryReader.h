/** Trajectories of other programs: EuRoC's csv, KITTI's rows, and TUM. */
#pragma once
#include "base/formats/Trajectory.h"

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
 * In the format of the first line with data. KITTI's stamps are read from <name>_times.txt or times.txt in its folder.
 */
Trajectory readTrajectory(const std::filesystem::path&);
}  // namespace scanloom
