/** Maps of keyframes in the formats that their names' endings say. */
#pragma once
#include "core/Keyframe.h"
#include "output/OctoMapExport.h"
#include "output/SimpleMapFile.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace scanloom
{
/** .bt, .ot, .ply, .simplemap, .3Dscene; throws UsageError for another ending, or two outputs of one. */
void requireMapEndings(const std::vector<std::filesystem::path>&);

/** A file that grows with the keyframes, and appears under its name by close(). */
class MapFile
{
 public:
  virtual ~MapFile() = default;
  virtual void add(const Keyframe&) = 0;
  virtual void close() = 0;
};

/** For outputs whose endings are known; .bt and .ot share a tree. Throws std::runtime_error if one cannot be begun. */
std::vector<std::unique_ptr<MapFile>> makeMapFiles(const std::vector<std::filesystem::path>&,
                                                   const std::vector<MountedLidar>&, const OctoMapOptions&);
}  // namespace scanloom
