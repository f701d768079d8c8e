/** Trajectories of other programs: EuRoC's csv, KITTI's rows, and TUM. */
#pragma once
#include "base/formats/Trajectory.h"

#include <functional>
#include <string>

namespace scanloom
{
/** Whether the first line with data begins with integer nanoseconds and a comma. */
bool isEuroc(const std::filesystem::path&);

/**
 * In the format of the first line with data: TUM; EuRoC's csv (integer ns, position, quaternion with w first, further
 * columns skipped); KITTI's odometry, twelve numbers a line. Throws std::invalid_argument with file and line for a line
 * that is no pose, and for poses out of order. KITTI's stamps are read from <name>_times.txt or times.txt in its
 * folder. Integer stamps of TUM that are no date in seconds are taken in the unit (ns, us, ms) in which they lie
 * between 1980 and 2112. A pose whose stamp is that of the one before is left out. `note` is called with both.
 */
Trajectory readTrajectory(const std::filesystem::path&, const std::function<void(const std::string&)>& note = nullptr);
}  // namespace scanloom
