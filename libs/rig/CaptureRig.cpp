#include "rig/CaptureRig.h"

#include "lidar/LidarModels.h"
#include "packets/MergedCaptures.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr int kDatagramsLookedAt = 20000;

using CountByPort = std::map<std::uint16_t, std::uint64_t>;

/** The expected port if packets came to it, else the one that got most of them, else the expected one. */
std::uint16_t portOf(std::uint16_t expected, const CountByPort& packets)
{
  if (packets.count(expected) > 0 || packets.empty()) return expected;
  return std::max_element(packets.begin(), packets.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}
}  // namespace

Rig captureRig(const std::vector<std::filesystem::path>& captures, const std::vector<std::string>& metadata_files)
{
  Rig rig;
  rig.captures = captures;
  for (const std::string& file : metadata_files)
    rig.lidars.push_back({std::filesystem::path(file).stem().string(), makeDecoder(file, Rigid::identity())});

  refuseOneSensorTwice(rig);

  std::vector<CountByPort> lidar_packets(rig.lidars.size()), imu_packets(rig.lidars.size());
  MergedCaptures datagrams(captures);
  Datagram datagram;
  for (int n = 0; n < kDatagramsLookedAt && datagrams.next(datagram); ++n)
    for (std::size_t i = 0; i < rig.lidars.size(); ++i)
    {
      const PacketKind kind = rig.lidars[i].decoder->kind(datagram.payload);
      if (kind == PacketKind::Lidar) ++lidar_packets[i][datagram.destination_port];
      if (kind == PacketKind::Imu) ++imu_packets[i][datagram.destination_port];
    }

  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
  {
    const LidarDescription& lidar = rig.lidars[i].decoder->description();
    LidarAddress address;
    address.lidar_port = portOf(lidar.lidar_port, lidar_packets[i]);
    address.imu_port = portOf(lidar.imu_port, imu_packets[i]);
    if (address.lidar_port == 0)
      throw UsageError(
          fmt::format("{}: names no udp_port_lidar, and the captures hold no packet of this lidar", metadata_files[i]));
    rig.addresses.push_back(address);
  }
  return rig;
}
}  // namespace scanloom
