/**
 * The occupancy map: A. Hornung et al.: OctoMap, Autonomous Robots 34 (2013). Every point marks its voxel occupied and
 * the line from *its own* lidar to it free: a merged origin would carve free space through the stems.
 */
#pragma once
#include "core/Field.h"
#include "core/Keyframe.h"

#include <filesystem>
#include <memory>
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
  double resolution = 0.1;
  double max_range = 20.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.resolution, Field{"resolution", "m", "edge of a voxel", above(0)});
    visit(o.max_range, Field{"max_range", "m", "points beyond only free the line up to here", above(0)});
  }
};

/** preview 0.2 m / 30 m, inventory 0.1 m / 20 m, fine 0.05 m / 15 m; throws std::invalid_argument on another name. */
OctoMapOptions octoMapPreset(const std::string& name);

class OctoMapBuilder
{
 public:
  /** `body_T_sensor` by sensor id: where each lidar's rays start. */
  OctoMapBuilder(const OctoMapOptions&, std::vector<Rigid> body_T_sensor);
  ~OctoMapBuilder();

  /**
   * Points farther from the map's origin than 32768 voxels are left out: the tree ends there. Takes seconds
   * and hundreds of MB for a keyframe of full scans (OctoMapEstimate.h): keyframes only. Throws
   * std::invalid_argument if a point's sensor_id has no pose.
   */
  void add(const Keyframe&);

  /** Its leaves are up to date, its inner nodes not before write(). */
  const octomap::OcTree& tree() const { return *tree_; }

  /**
   * .bt (occupied or free) and .ot (log odds); an empty path is left out. Ends the building: a copy of a large tree
   * would not fit into memory beside it. Throws std::runtime_error if a file cannot be written.
   */
  void write(const std::filesystem::path& binary, const std::filesystem::path& full) &&;

 private:
  OctoMapOptions options_;
  std::vector<Rigid> body_T_sensor_;
  std::unique_ptr<octomap::OcTree> tree_;
};
}  // namespace scanloom
