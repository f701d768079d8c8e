#include "input/rig/receiverOptions.h"

#include <map>

namespace scanloom
{
namespace
{
// Datagrams that wait between the threads per lidar and port: half a second of most lidars.
constexpr std::size_t kSlotsPerLidar = 1024;
}  // namespace

UdpReceiverOptions receiverOptions(const Rig& rig)
{
  struct Users
  {
    std::vector<IpAddress> sources;
    std::size_t lidars = 0;
    bool anybody = false;  // one of the lidars has no known address
  };
  std::map<std::uint16_t, Users> users;
  const auto add = [&users](std::uint16_t port, const LidarAddress& address)
  {
    Users& of_port = users[port];
    ++of_port.lidars;
    if (address.source)
      of_port.sources.push_back(*address.source);
    else
      of_port.anybody = true;
  };
  for (const LidarAddress& address : rig.addresses)
  {
    add(address.lidar_port, address);
    if (address.imu_port != 0 && address.imu_port != address.lidar_port) add(address.imu_port, address);
  }

  UdpReceiverOptions options;
  options.bind_address = rig.live.bind_address;
  options.receive_buffer = rig.live.receive_buffer;
  for (const auto& [port, of_port] : users)
    options.ports.push_back(
        {port, of_port.anybody ? std::vector<IpAddress>{} : of_port.sources, of_port.lidars * kSlotsPerLidar});
  return options;
}
}  // namespace scanloom
