/** Point clouds of other programs. */
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
  std::vector<double> times;            // of the points, in the file's unit; empty: it has none
  std::size_t dropped = 0;              // points that are not finite
};

/**
 * x, y and z, and the times if there are any, of a PLY, PCD or KITTI scan (.bin: float x y z intensity), by the ending
 * of its name; each may be gzipped
 * (.gz). Doubles are rounded to floats: clouds in national coordinates lose precision. Throws std::runtime_error with
 * the path and what is wrong.
 */
CloudFile readCloud(const std::filesystem::path&);
}  // namespace scanloom
