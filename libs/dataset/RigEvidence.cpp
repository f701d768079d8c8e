#include "dataset/RigEvidence.h"

#include <algorithm>

namespace scanloom
{
namespace
{
std::vector<RoutedLidar> routesOf(const Rig& rig)
{
  std::vector<RoutedLidar> routes;
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
    routes.push_back({rig.lidars[i].name, rig.addresses[i], rig.lidars[i].decoder.get()});
  return routes;
}
Duration longestTurn(const Rig& rig)
{
  double slowest = 20;  // Hz
  for (const BatchedLidar& lidar : rig.lidars) slowest = std::min(slowest, lidar.decoder->description().frame_rate);
  return fromSeconds(1 / slowest);
}
}  // namespace

RigListener::RigListener(const Rig& rig, bool poses_known)
  : lidars_(rig.lidars),
    addresses_(rig.addresses),
    router_(routesOf(rig)),
    snapshots_(rig.lidars.size(), longestTurn(rig)),
    delays_(rig.lidars.size(), Duration{0})
{
  evidence_.imus.push_back({"imu", rig.body_imu, rig.body_T_imu});
  for (const BatchedLidar& lidar : lidars_)
  {
    const LidarDescription& description = lidar.decoder->description();
    evidence_.lidars.push_back({lidar.name, description, {}, 0, 0});
    evidence_.imus.push_back({"imu_" + lidar.name, {}, description.body_T_sensor * description.sensor_T_imu});
  }
  evidence_.poses_known = poses_known;
  evidence_.deadline = fromSeconds(1e-3 * rig.batcher.deadline_ms);
}

void RigListener::add(const DatagramView& datagram)
{
  const std::optional<Routed> routed = router_.route(datagram);
  if (!routed) return;
  const BatchedLidar& lidar = lidars_[routed->lidar];
  LidarEvidence& evidence = evidence_.lidars[routed->lidar];
  switch (routed->kind)
  {
    case PacketKind::Lidar:
      addPacket(routed->lidar, datagram);
      break;
    case PacketKind::Imu:
      for (ImuSample& sample : lidar.decoder->imuSamples(datagram.payload))
      {
        sample.stamp += lidar.time_offset;
        evidence_.imus[1 + routed->lidar].samples.push_back(sample);
      }
      break;
    case PacketKind::Malformed:
      ++evidence.malformed;
      break;
    case PacketKind::BadCrc:
      ++evidence.bad_crc;
      break;
    case PacketKind::Other:
    case PacketKind::Foreign:
      break;
  }
}

void RigListener::addPacket(std::size_t index, const DatagramView& datagram)
{
  const BatchedLidar& lidar = lidars_[index];
  PacketTrace trace = traceOf(*lidar.decoder, datagram.payload, datagram.received, blocks_);
  if (trace.stamp)
  {
    const Duration round = lidar.decoder->description().stamp_modulus;
    trace.stamp = unwrapped(*trace.stamp + lidar.time_offset, round, datagram.received - delays_[index]);
    delays_[index] = datagram.received - *trace.stamp;
  }
  evidence_.lidars[index].packets.push_back(trace);
  snapshots_.add(index, *lidar.decoder, datagram.payload, blocks_, datagram.received);
}

RigEvidence RigListener::finish()
{
  for (const auto& [origin, datagrams] : router_.unmatched())
    if (std::any_of(addresses_.begin(), addresses_.end(),
                    [port = origin.destination_port](const LidarAddress& address)
                    { return port == address.lidar_port || port == address.imu_port; }))
      evidence_.strangers[origin] = datagrams;
  evidence_.snapshots = snapshots_.finish();
  auto& imus = evidence_.imus;
  imus.erase(std::remove_if(imus.begin(), imus.end(), [](const ImuEvidence& imu) { return imu.samples.empty(); }),
             imus.end());
  return std::move(evidence_);
}
}  // namespace scanloom
