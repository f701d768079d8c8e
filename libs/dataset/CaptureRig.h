/** A rig put together from captures and metadata alone, for those who have no configuration yet. */
#pragma once
#include "source/Rig.h"

namespace scanloom
{
/**
 * Lidars are called after their metadata files and sit in the body's origin. A lidar's port is that of its metadata or,
 * where its packets come to another one in the beginning of the captures, that one. Throws what MergedCaptures and
 * makeDecoder throw, and UsageError if a metadata file names no port and fits no packet.
 */
Rig captureRig(const std::vector<std::filesystem::path>& captures, const std::vector<std::string>& metadata_files);
}  // namespace scanloom
