/** What a capture holds: datagrams by sender and port, and what lidars' decoders read in them. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/packets/CaptureReader.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
/** The datagrams of one sender to one port. */
struct CaptureStream
{
  IpAddress source;
  std::uint16_t destination_port = 0;
  std::uint64_t datagrams = 0;
  std::size_t smallest = 0, largest = 0;  // bytes of payload
  Timestamp first, last;                  // record time
};

/** What one lidar's decoder reads in a capture. */
struct DecodedCapture
{
  LidarDescription lidar;
  // By kind: "lidar", "imu", "other", "malformed", "bad_crc", "foreign"; "imu_of_several": neither serial number nor
  // address tell which of the lidars has sent it.
  std::map<std::string, std::uint64_t> packets;
  std::uint64_t valid_blocks = 0, invalid_blocks = 0;
  std::uint64_t imu_samples = 0;
  Timestamp first, last;  // sensor time of valid blocks
};

struct CaptureInfo
{
  CaptureCounters counters;
  std::vector<CaptureStream> streams;  // by source, then port
  std::vector<DecodedCapture> lidars;  // one per metadata file
};

/** Throws as CaptureReader and makeDecoder do. */
CaptureInfo captureInfo(const std::filesystem::path& capture, const std::vector<std::string>& metadata_files);
}  // namespace scanloom
