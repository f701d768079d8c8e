/** Which lidars a capture holds, and where their packets are. */
#pragma once
#include "input/lidar/PacketDecoder.h"
#include "input/rig/internal/SampledStreams.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** What may describe a lidar of the recording. */
struct MetadataCandidate
{
  std::filesystem::path file;                    // or the name of a built-in model
  std::shared_ptr<const PacketDecoder> decoder;  // null if the file is faulty
  std::string fault;
};

/** Of files or names of built-in models; a faulty one is a candidate that fits nothing. */
std::vector<MetadataCandidate> candidatesFrom(const std::vector<std::filesystem::path>& metadata_files);

/** Of texts by the topics of a bag that hold them: their file is "topic:NAME". */
std::vector<MetadataCandidate> candidatesFrom(const std::map<std::string, std::string>& metadata_by_topic);

/** "/left/" of "/left/lidar_packets". */
std::string nameSpaceOf(const std::string& topic);

struct FoundLidar
{
  std::filesystem::path metadata;
  LidarDescription description;
  IpAddress source;
  std::uint16_t port = 0;
  std::uint16_t imu_port = 0;            // 0: no IMU packet came
  std::string topic, imu_topic;          // of a bag, instead of ports; empty in a capture
  bool source_matters = false;           // another lidar sends to the same port
  std::optional<Timestamp> first_stamp;  // of its valid blocks, by its own clock
};

struct LidarsFound
{
  std::vector<FoundLidar> lidars;          // by port, source, topic
  std::vector<MetadataCandidate> unheard;  // of sensors that none of the packets are of
  std::vector<MetadataCandidate> faulty;   // that cannot be read
  bool left_streams_out = false;           // that may be lidars': notes say which
  std::vector<std::string> notes;          // what is left out, and why
};

/** Which of them share a port, and must be distinguished by their addresses. */
void markSharedPorts(std::vector<FoundLidar>&);

/**
 * A lidar is in a stream if its decoder understands packets of it: size, format, serial number and checksum fit, and
 * packets that have no numbers follow each other at its pace. A stream that no candidate fits may be of a built-in
 * model. Where several candidates fit, the one that is named like a capture is taken, or the one that names the
 * stream's port, or the only one that fits no other stream. Throws UsageError if that leaves several, and if no lidar
 * is found; the message says for each candidate why it does not fit.
 */
LidarsFound findLidars(const std::vector<SampledStream>&, std::vector<MetadataCandidate>,
                       const std::vector<std::filesystem::path>& captures);
}  // namespace scanloom
