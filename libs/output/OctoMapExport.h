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

  /** Throws std::invalid_argument if a point's sensor_id has no pose. Seconds for 131k points at 0.1 m: keyframes only.
   */
  void add(const Keyframe&);

  const octomap::OcTree& tree() const { return *tree_; }

  /** .bt: occupied or free, most likely state, pruned. Throws std::runtime_error if it cannot be written. */
  void writeBinary(const std::filesystem::path&) const;

  /** .ot: log odds of every voxel. */
  void writeFull(const std::filesystem::path&) const;

 private:
  OctoMapOptions options_;
  std::vector<Rigid> body_T_sensor_;
  std::unique_ptr<octomap::OcTree> tree_;
};
}  // namespace scanloom
