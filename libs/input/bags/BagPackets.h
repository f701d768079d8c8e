/** The packets of bags, as they come. */
#pragma once
#include "input/bags/BagReader.h"
#include "input/packets/DatagramReader.h"

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The topics of all bags with packets of lidars. Where no topic has packets, those with clouds
 * (sensor_msgs/PointCloud2) count: a cloud becomes a packet (CloudPacket.h). Captures among the files have none. Throws
 * what BagReader::open throws.
 */
std::set<std::string> packetTopicsOf(const std::vector<std::filesystem::path>& recordings);

/**
 * Captures and bags, each as a reader of datagrams; of bags they are those of MessagePackets. Throws as CaptureReader
 * and BagReader::open do, and std::invalid_argument without files.
 */
std::vector<std::unique_ptr<DatagramReader>> datagramsOf(const std::vector<std::filesystem::path>& recordings);
}  // namespace scanloom
