/** Point clouds of other programs. */
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
struct CloudFile
{
  std::vector<Eigen::Vector3f> points;  // finite
  std::vector<double> times;            // of the points, in the file's unit; empty: it has none
  std::size_t dropped = 0;              // points that are not finite
  std::string note;                     // what was concluded about the file; empty: nothing had to be
};

/** Whether a file begins like a PLY or PCD. */
bool beginsLikeCloud(std::string_view bytes);

/**
 * x, y and z, and the times if there are any, of a PLY or PCD, as its first bytes say, or of floats like KITTI's scans
 * (.bin: nothing but its name tells what it is), each also in gzip or zstd. Doubles are rounded to floats: clouds in
 * national coordinates lose precision. Throws std::runtime_error with the path and what is wrong.
 */
CloudFile readCloud(const std::filesystem::path&);
}  // namespace scanloom
