/** Clouds of several lidars at one instant, from files. */
#pragma once
#include "base/core/MountedLidar.h"
#include "calibration/StaticExtrinsics.h"

#include <filesystem>
#include <vector>

namespace scanloom
{
struct StaticClouds
{
  std::vector<MountedLidar> lidars;
  std::vector<StaticLidar> points;  // of each
  PoseGiven poses = PoseGiven::No;
};

/**
 * Each cloud is called like its lidar: left.pcd is that of 'left', and its pose that of a line T_body_left in one of
 * the files of `extrinsics`. Without such a file no pose is known. Throws std::runtime_error for a file that cannot be
 * read, for a cloud without a pose where others have one, and for two of one name.
 */
StaticClouds readStaticClouds(const std::vector<std::filesystem::path>& clouds,
                              const std::vector<std::filesystem::path>& extrinsics);
}  // namespace scanloom
