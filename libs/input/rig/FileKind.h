#pragma once
#include <filesystem>

namespace scanloom
{
/** What a file of a recording is good for. */
enum class FileKind
{
  Capture,        // pcap, pcapng, a bag of ROS, or a rawlog of packets
  Rawlog,         // of MRPT, other
  Cloud,          // PLY, PCD, KITTI
  LidarMetadata,  // of any known brand
  BodyImu,        // csv
  Extrinsics,     // lines "T_body_<name> x y z yaw pitch roll"
  Other,
};

/**
 * By the first bytes, those of a gzip or zstd file unpacked. Throws std::runtime_error if the file cannot be read or
 * unpacked.
 */
FileKind kindOf(const std::filesystem::path&);
}  // namespace scanloom
