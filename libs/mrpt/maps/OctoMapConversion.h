/** Maps made of an existing OctoMap. */
#pragma once
#include <octomap/octomap.h>

#include <filesystem>
#include <vector>

namespace scanloom
{
/** Throws UsageError for an output that cannot be made of this .bt or .ot; endings are known (requireMapEndings). */
void requireConvertible(const std::filesystem::path& octomap, const std::vector<std::filesystem::path>& outputs);

/** Writes each output in the format of its ending: .ply, .ot, .bt or .3Dscene. A .bt rounds the tree's values. */
void convertOctoMap(octomap::OcTree&, const std::vector<std::filesystem::path>& outputs);
}  // namespace scanloom
