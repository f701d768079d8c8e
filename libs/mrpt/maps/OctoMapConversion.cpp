#include "mrpt/maps/OctoMapConversion.h"

#include "base/core/ConfigError.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/SceneFile.h"
#include "mrpt/maps/internal/VoxelPly.h"

#include <string>

namespace scanloom
{
void requireConvertible(const std::filesystem::path& octomap, const std::vector<std::filesystem::path>& outputs)
{
  for (const std::filesystem::path& output : outputs)
  {
    if (output.extension() == ".simplemap")
      throw UsageError("an OctoMap holds no scans: it cannot become a .simplemap");
    if (const auto ending = output.extension(); ending == ".pcd" || ending == ".las" || ending == ".laz")
      throw UsageError(
          "an OctoMap holds voxels: they become a .ply; make .pcd, .las and .laz of keyframes or a rawlog");
    if (output.extension() == ".ot" && octomap.extension() == ".bt")
      throw UsageError("a .bt holds no log odds: it cannot become an .ot");
  }
}

void convertOctoMap(octomap::OcTree& tree, const std::vector<std::filesystem::path>& outputs)
{
  for (const std::filesystem::path& output : outputs)
  {
    const std::string ending = output.extension().string();
    if (ending == ".ply") writeVoxelPly(output, tree);
    if (ending == ".ot") writeFullOctoMap(output, tree);
    if (ending == ".3Dscene")
    {
      SceneBuilder scene;
      scene.addOccupied(tree);
      writeScene(output, *scene.finished());
    }
  }
  // Last, because writing a .bt changes the tree.
  for (const std::filesystem::path& output : outputs)
    if (output.extension() == ".bt") writeBinaryOctoMap(output, tree);
}
}  // namespace scanloom
