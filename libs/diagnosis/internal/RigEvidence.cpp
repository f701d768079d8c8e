#include "diagnosis/internal/RigEvidence.h"

#include "base/core/unwrapped.h"

#include <algorithm>

namespace scanloom
{
namespace
{
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
  evidence_.imus.push_back({"imu", rig.body_imu, rig.body_T_imu.value_or(Rigid{}), rig.body_T_imu.value_or(Rigid{})});
  for (std::size_t i = 0; i < lidars_.size(); ++i)
  {
    const BatchedLidar& lidar = lidars_[i];
    LidarDescription description = lidar.decoder->description();
    description.lidar_port = addresses_[i].lidar_port;
    description.imu_port = addresses_[i].imu_port;
    evidence_.lidars.push_back({lidar.name, description, {}, 0, 0});
    evidence_.imus.push_back(
        {"imu_" + lidar.name, {}, description.body_T_sensor * description.sensor_T_imu, description.body_T_sensor});
  }
  evidence_.poses_known = poses_known;
  evidence_.deadline = fromSeconds(1e-3 * rig.batcher.deadline_ms);
}

void RigListener::add(const DatagramView& datagram)
{
  const std::optional<RoutedPacket> routed = router_.route(datagram);
  if (!routed) return;
  const BatchedLidar& lidar = lidars_[routed->lidar];
  LidarEvidence& evidence = evidence_.lidars[routed->lidar];
  switch (routed->kind)
  {
    case PacketKind::Lidar:
      addPacket(*routed);
      break;
    case PacketKind::Imu:
      for (ImuSample& sample : lidar.decoder->imuSamples(routed->bytes))
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

void RigListener::addPacket(const RoutedPacket& packet)
{
  const BatchedLidar& lidar = lidars_[packet.lidar];
  const LidarDescription& description = lidar.decoder->description();
  PacketTrace trace = traceOf(packet, description);
  if (trace.stamp)
  {
    Duration& delay = delays_[packet.lidar];
    trace.stamp = unwrapped(*trace.stamp + lidar.time_offset, description.stamp_modulus, packet.received - delay);
    delay = packet.received - *trace.stamp;
  }
  evidence_.lidars[packet.lidar].packets.push_back(trace);
  snapshots_.add(packet.lidar, *lidar.decoder, packet.bytes, packet.blocks, packet.received);
}

RigEvidence RigListener::finish()
{
  for (const auto& [origin, datagrams] : router_.unmatched())
    if (std::any_of(addresses_.begin(), addresses_.end(),
                    [&place = origin](const LidarAddress& address)
                    { return address.receives(place.destination_port, place.topic); }))
      evidence_.other_senders[origin] = datagrams;
  evidence_.wrong_keys = router_.takeWarnings();
  evidence_.snapshots = snapshots_.finish();
  auto& imus = evidence_.imus;
  imus.erase(std::remove_if(imus.begin(), imus.end(), [](const ImuEvidence& imu) { return imu.samples.empty(); }),
             imus.end());
  return std::move(evidence_);
}
}  // namespace scanloom
