/** Maps of keyframes, in formats by the endings of the files' names. */
#pragma once
#include "base/core/Keyframe.h"
#include "mrpt/maps/OctoMapExport.h"
#include "mrpt/maps/SimpleMapFile.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace scanloom
{
/** Throws UsageError for an ending other than .bt, .ot, .ply, .pcd, .las, .laz, .simplemap and .3Dscene, or the same
 * ending twice. */
void requireMapEndings(const std::vector<std::filesystem::path>&);

/**
 * What coordinates of map files should be less: floats, and trees of voxels, hold none of a country. Zero if the first
 * pose is within 10 km of the origin, else whole kilometres near it.
 */
Eigen::Vector3d offsetFor(const Rigid& first_pose);

/** Map files that close() completes and renames to their names. */
class MapFiles
{
 public:
  /**
   * For outputs with known endings; .bt and .ot share a tree. All but .simplemap have coordinates less `offset`. Throws
   * std::runtime_error if a file cannot be opened.
   */
  MapFiles(const std::vector<std::filesystem::path>&, const std::vector<MountedLidar>&, const OctoMapOptions&,
           const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());
  ~MapFiles();

  void add(const Keyframe&);
  void close();

  /** Points that a tree of voxels could not hold: each side has 32768 from its origin. */
  std::uint64_t leftOut() const;

 private:
  class File;
  class Cloud;
  class SimpleMap;
  class Scene;
  class OctoMap;
  std::vector<std::unique_ptr<File>> files_;
};
}  // namespace scanloom
