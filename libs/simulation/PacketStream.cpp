#include "simulation/PacketStream.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr Duration kImuPeriod = 10ms;
// Assumed, as nothing is published: what a cheap MEMS of the kind shows, in SI units and densities per root of Hz.
const ImuErrors kBuiltInImu{{0.01, 1.8e-3, 1e-3, 1e-4}, {{6e-3, -3e-3, 4e-3}, {0.15, -0.2, 0.1}}};

/** Transport takes 0.1 ms and rarely, when the computer was busy, up to 2 ms more: less than between two packets. */
constexpr Duration kTransport = 60us;
constexpr double kUsualJitter = 80e-6;
constexpr double kRareJitter = 2e-3;
constexpr double kRareShare = 0.003;

constexpr std::uint64_t kImuIndexOffset = 1ULL << 40;  // keeps the IMU's random numbers apart from the packets'
}  // namespace

PacketStream::PacketStream(const Scene& scene, const LidarStation& station)
  : scene_(scene), station_(station), encoder_(station.lidar.metadata())
{
  Eigen::Matrix4d sensor_T_imu = station.lidar.metadata().imu_to_sensor_mm;
  sensor_T_imu.topRightCorner<3, 1>() *= 1e-3;
  const Rigid body_T_imu = station.lidar.bodyTSensor() * Rigid::fromMatrix(sensor_T_imu);
  const Timestamp first = station.lidar.stampOf(scene.span.start, 0) - 7ms;
  imu_ = simulateImu(scene.drive, scene.span, body_T_imu, first, kImuPeriod, kBuiltInImu, scene.seed, station.imu);
}

std::vector<Datagram> PacketStream::finishedBefore(Timestamp until)
{
  const std::uint64_t first = next_packet_;
  while (lastStampOf(next_packet_) < until) ++next_packet_;

  std::vector<Datagram> datagrams(next_packet_ - first);
  tbb::parallel_for(std::size_t{0}, datagrams.size(), [&](std::size_t i) { datagrams[i] = lidarDatagram(first + i); });

  for (; next_imu_ < imu_.size() && imu_[next_imu_].stamp < until; ++next_imu_)
    datagrams.push_back(imuDatagram(imu_[next_imu_], next_imu_));
  return datagrams;
}

Timestamp PacketStream::lastStampOf(std::uint64_t packet) const
{
  const auto columns = static_cast<std::uint64_t>(station_.lidar.metadata().columns_per_packet);
  return station_.lidar.stampOf(scene_.span.start, columns * (packet + 1) - 1);
}

Datagram PacketStream::lidarDatagram(std::uint64_t packet) const
{
  const int count = station_.lidar.metadata().columns_per_packet;
  std::vector<OusterColumn> columns;
  for (int i = 0; i < count; ++i)
    columns.push_back(station_.lidar.measure(scene_.world, scene_.drive, scene_.span.start, packet * count + i));

  const std::uint16_t port = station_.lidar.metadata().lidar_port;
  return {received(columns.back().stamp, packet), IpAddress::parse("127.0.0.1"), port, port,
          encoder_.lidarPacket(columns)};
}

Datagram PacketStream::imuDatagram(const ImuSample& sample, std::uint64_t index) const
{
  const std::uint16_t port = station_.lidar.metadata().imu_port;
  return {received(sample.stamp, kImuIndexOffset + index), IpAddress::parse("127.0.0.1"), port, port,
          encoder_.imuPacket({sample})};
}

Timestamp PacketStream::received(Timestamp measured, std::uint64_t index) const
{
  Random random(scene_.seed, station_.transport, index);
  const double jitter = random.uniform() < kRareShare ? kRareJitter : kUsualJitter;
  return measured + kTransport + fromSeconds(jitter * random.uniform());
}
}  // namespace scanloom
