/** What a capture holds: who sent how much to which port, and what a lidar's metadata makes of it. */
#pragma once
#include "lidar/PacketDecoder.h"
#include "source/CaptureReader.h"

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

/** A capture seen by one lidar's decoder. */
struct DecodedCapture
{
  LidarDescription lidar;
  std::map<std::string, std::uint64_t> packets;  // by kind: lidar, imu, other, malformed, bad_crc, foreign
  std::uint64_t valid_blocks = 0, invalid_blocks = 0;
  std::uint64_t imu_samples = 0;
  Timestamp first, last;                                    // sensor time of valid blocks
  std::vector<std::map<std::string, std::string>> digests;  // turn by turn, field name to md5; only if asked for
};

struct CaptureInfo
{
  CaptureCounters counters;
  std::vector<CaptureStream> streams;  // by source, then port
  std::vector<DecodedCapture> lidars;  // one per metadata file
};

enum class Digests
{
  No,
  Yes,
};

/** Throws what CaptureReader and makeDecoder throw. */
CaptureInfo captureInfo(const std::filesystem::path& capture, const std::vector<std::string>& metadata_files, Digests);

/** Whether the file begins like a pcap or pcapng. Throws std::runtime_error if it cannot be read. */
bool isCapture(const std::filesystem::path&);
}  // namespace scanloom
