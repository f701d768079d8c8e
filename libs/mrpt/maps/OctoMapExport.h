/**
 * The occupancy map: A. Hornung et al.: OctoMap, Autonomous Robots 34 (2013). Every point marks its voxel as occupied
 * and the line from the lidar that measured it as free. Lines from one common origin would mark parts of stems as free.
 */
#pragma once
#include "base/core/Keyframe.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octomap
{
class OcTree;
}

namespace scanloom
{
struct OctoMapOptions
{
  double resolution = 0.1;  // m, edge of a voxel
  double max_range = 20.0;  // m: a farther point marks only the first part of its line, up to this range, as free
};

/** preview 0.2 m / 30 m, inventory 0.1 m / 20 m, fine 0.05 m / 15 m; throws std::invalid_argument on another name. */
OctoMapOptions octoMapPreset(const std::string& name);

/** A square of the map, whose corners are at multiples of 32 voxels. */
struct MapArea
{
  Eigen::Vector2d least;  // m, its corner of least x and y
  double edge;            // m
};

class OctoMapBuilder
{
 public:
  /** `body_T_sensor` by sensor id: where each lidar's rays start. `area`: only what is in it becomes part of the map.
   */
  OctoMapBuilder(const OctoMapOptions&, std::vector<Rigid> body_T_sensor,
                 const std::optional<MapArea>& area = std::nullopt);
  ~OctoMapBuilder();

  /**
   * Points farther from the map's origin than 32768 voxels, the size of the tree, are left out and counted. A keyframe
   * of full scans takes seconds and hundreds of MB (OctoMapEstimate.h). Throws std::invalid_argument for a sensor_id
   * without a pose.
   */
  void add(const Keyframe&);

  /** Points that were left out. */
  std::uint64_t leftOut() const { return left_out_; }

  /** Its leaves are up to date; its inner nodes only after write(). */
  const octomap::OcTree& tree() const { return *tree_; }

  /**
   * Writes .bt (occupied or free) and .ot (log odds), each if its path is not empty. The builder cannot be used any
   * more: writing changes the tree, and memory may not suffice for a copy. Throws std::runtime_error on failure.
   */
  void write(const std::filesystem::path& binary, const std::filesystem::path& full) &&;

 private:
  OctoMapOptions options_;
  std::vector<Rigid> body_T_sensor_;
  std::optional<MapArea> area_;
  std::unique_ptr<octomap::OcTree> tree_;
  std::uint64_t left_out_ = 0;
};
}  // namespace scanloom
