/** The packets of bags, as if they were captures. */
#pragma once
#include "input/bags/BagReader.h"
#include "input/packets/DatagramReader.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The UDP port that stands for each topic with packets of lidars: 1 for the first by name, 2 for the next, ... Of
 * several bags all topics together; a topic of two bags is one. Where no topic has packets, those with clouds
 * (sensor_msgs/PointCloud2) count: a cloud becomes a packet (CloudPacket.h). Captures among the files have none. Throws
 * what BagReader::open throws.
 */
std::map<std::string, std::uint16_t> portsOfTopics(const std::vector<std::filesystem::path>& recordings);

/**
 * Captures and bags, each as a reader of datagrams. A datagram of a bag comes from no address, goes to the port of its
 * topic, and was received at the stamp that the driver gave the packet; where it gave none, at the receive time of its
 * message. Drivers put the packets of a turn into one message: they come in the order of stamps as far as those of one
 * turn differ. Throws as CaptureReader and BagReader::open do, and std::invalid_argument without files.
 */
std::vector<std::unique_ptr<DatagramReader>> datagramsOf(const std::vector<std::filesystem::path>& recordings);
}  // namespace scanloom
