/** A rig from captures and metadata files alone, without a configuration. */
#pragma once
#include "rig/Rig.h"

namespace scanloom
{
/**
 * Lidars have the names of their metadata files; their sensor frames are taken for the body frame. A lidar's port is
 * that of its metadata or, if the first packets of the captures go to another one, that one. Throws what MergedCaptures
 * and makeDecoder throw, and UsageError if a metadata file names no port and no packet fits it.
 */
Rig captureRig(const std::vector<std::filesystem::path>& captures, const std::vector<std::string>& metadata_files);
}  // namespace scanloom
