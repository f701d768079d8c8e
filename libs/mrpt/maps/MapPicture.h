/** A picture of the map from above: what stands at breast height, and the paths through it. */
#pragma once
#include "base/core/Keyframe.h"
#include "base/formats/Trajectory.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

namespace scanloom
{
struct MapPictureOptions
{
  double margin = 20.0;                 // m, around the trajectory
  int longest_side = 1600;              // px, width or height
  std::size_t most_voxels = 8'000'000;  // 300 MB: of half a kilometre through a dense stand
};

/** A line between two places of the map. */
struct MapLink
{
  Eigen::Vector3d from, to;  // m
  bool is_good = true;
};

/**
 * Collects the points of the keyframes as voxels of 0.1 m, which become twice as wide, 0.2 m, 0.4 m and so on, whenever
 * they are too many: those of a longer drive are smaller than a pixel. Draws a PNG with the map's y axis up: ground
 * coloured by elevation, vegetation pale, points 1.0 to 1.6 m above the ground dark, paths and links on top, a scale
 * bar and a legend.
 */
class MapPicture
{
 public:
  explicit MapPicture(const MapPictureOptions& options) : options_(options) {}

  void add(const Keyframe&);

  /** Throws std::invalid_argument without a pose, std::runtime_error if the file cannot be written. */
  void write(const std::filesystem::path&, const std::vector<Trajectory>& paths, const std::string& title,
             const std::vector<MapLink>& links = {}) const;

 private:
  void widen();

  MapPictureOptions options_;
  int widened_ = 0;  // how often
  std::unordered_set<std::uint64_t> voxels_;
};
}  // namespace scanloom
