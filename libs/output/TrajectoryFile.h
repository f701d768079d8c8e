/** Trajectories in the format that a file's name says: .tum, .csv (EuRoC) or .txt (KITTI, with its stamps beside). */
#pragma once
#include "output/Trajectory.h"

#include <filesystem>
#include <vector>

namespace scanloom
{
bool isTrajectoryName(const std::filesystem::path&);

/** All that writeTrajectory() writes: beside NAME.txt there is NAME_times.txt. */
std::vector<std::filesystem::path> trajectoryFiles(const std::filesystem::path&);

/** Throws std::invalid_argument for another ending, std::runtime_error if a file cannot be written. */
void writeTrajectory(const std::filesystem::path&, const Trajectory&);
}  // namespace scanloom
