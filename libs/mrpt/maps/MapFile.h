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

/** A map file that close() completes and renames to its name. */
class MapFile
{
 public:
  virtual ~MapFile() = default;
  virtual void add(const Keyframe&) = 0;
  virtual void close() = 0;
};

/** For outputs with known endings; .bt and .ot share a tree. Throws std::runtime_error if a file cannot be opened. */
std::vector<std::unique_ptr<MapFile>> makeMapFiles(const std::vector<std::filesystem::path>&,
                                                   const std::vector<MountedLidar>&, const OctoMapOptions&);
}  // namespace scanloom
