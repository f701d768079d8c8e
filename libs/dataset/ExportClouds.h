#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
enum class CloudFormat
{
  Ply,    // PlyWriter
  Pcd,    // writePcd
  Kitti,  // writeKittiScan
};

/**
 * Each cloud as a file in the body frame, in the file's order: `<folder>/<label>/000000.ply`, and in
 * `<folder>/<label>/times.txt` their stamps in s, one a line. KITTI's clouds lie in `<folder>/<label>/velodyne`. Slices
 * are left out. Passes nothing on. Throws std::runtime_error if something cannot be written.
 */
RawlogOperation exportClouds(CloudFormat, const std::filesystem::path& folder, const std::optional<RecordingHeader>&);
}  // namespace scanloom
