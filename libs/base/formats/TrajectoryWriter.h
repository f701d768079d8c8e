/** Trajectories in the format of the file's ending: .tum, .csv (EuRoC) or .txt (KITTI, with a second file of stamps).
 */
#pragma once
#include "base/formats/Trajectory.h"

#include <filesystem>
#include <vector>

namespace scanloom
{
bool isTrajectoryName(const std::filesystem::path&);

/** All files that writeTrajectory() writes: with NAME.txt also NAME_times.txt. */
std::vector<std::filesystem::path> trajectoryFiles(const std::filesystem::path&);

/** Throws std::invalid_argument for another ending, std::runtime_error if a file cannot be written. */
void writeTrajectory(const std::filesystem::path&, const Trajectory&);
}  // namespace scanloom
