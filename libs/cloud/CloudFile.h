/** Point clouds as other programs keep them. */
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace scanloom
{
struct CloudFile
{
  std::vector<Eigen::Vector3f> points;  // finite
  std::size_t dropped = 0;              // those that were not
};

/**
 * x, y and z of a PLY, a PCD or a KITTI scan (.bin: float x y z intensity), chosen by the ending of its name; each may
 * also be gzipped (.gz). Doubles become floats: move clouds in national coordinates near to 0 first. Throws
 * std::runtime_error with the path and what is wrong.
 */
CloudFile readCloud(const std::filesystem::path&);
}  // namespace scanloom
