/** LAZ: LAS without loss in fewer bytes, by LASzip (M. Isenburg, 2013), which Debian has from release 13 on. */
#pragma once
#include <filesystem>

namespace scanloom
{
/** Whether LASzip was there when scanloom was built. */
bool hasLaszip();

/** Replaces the content of `laz`. Throws std::runtime_error with LASzip's reason, or if there is no LASzip. */
void compressLas(const std::filesystem::path& las, const std::filesystem::path& laz);
}  // namespace scanloom
