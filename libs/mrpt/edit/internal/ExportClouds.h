#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
enum class CloudFormat
{
  Ply,    // CloudWriter
  Pcd,    // CloudWriter
  Kitti,  // writeKittiScan
};

/**
 * Writes each cloud to a file in the body frame, `<folder>/<label>/000000.ply` and on, and their stamps in s, one a
 * line, to `<folder>/<label>/times.txt`. KITTI's clouds lie in `<folder>/<label>/velodyne`. Slices are left out. Throws
 * std::runtime_error if something cannot be written.
 */
RawlogOperation exportClouds(CloudFormat, const std::filesystem::path& folder, const std::optional<RecordingHeader>&);
}  // namespace scanloom
