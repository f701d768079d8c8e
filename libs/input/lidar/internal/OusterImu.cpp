#include "input/lidar/internal/OusterImu.h"

#include <algorithm>

namespace scanloom
{
namespace
{
Eigen::Vector3d loadVector(Bytes bytes, std::size_t offset)
{
  return {load<float>(bytes, offset), load<float>(bytes, offset + 4), load<float>(bytes, offset + 8)};
}

void appendIfUsable(std::vector<ImuSample>& samples, std::uint64_t stamp, const Eigen::Vector3d& gyro,
                    const Eigen::Vector3d& accel)
{
  if (stamp < kOusterEndOfTime && gyro.allFinite() && accel.allFinite())
    samples.push_back({fromNanoseconds(static_cast<std::int64_t>(stamp)), gyro, accel});
}

std::vector<ImuSample> readLegacy(Bytes packet)
{
  namespace at = ouster_legacy_imu;
  std::vector<ImuSample> samples;
  appendIfUsable(samples, load<std::uint64_t>(packet, at::kGyroStamp), kOusterDegree * loadVector(packet, at::kGyro),
                 kOusterStandardGravity * loadVector(packet, at::kAccel));
  return samples;
}

std::vector<ImuSample> readAccelGyro(Bytes packet, const OusterLayout& layout)
{
  namespace at = ouster_accel_gyro;
  const std::size_t first = headerFields(layout.imu_header).bytes + at::kNmeaBytes;
  std::vector<ImuSample> samples;
  for (std::size_t i = 0; i < layout.imu_measurements; ++i)
  {
    const Bytes measurement = packet.slice(first + i * at::kMeasurementBytes, at::kMeasurementBytes);
    if ((load<std::uint16_t>(measurement, at::kStatus) & 1) == 0) continue;
    appendIfUsable(samples, load<std::uint64_t>(measurement, at::kStamp), loadVector(measurement, at::kGyro),
                   loadVector(measurement, at::kAccel));
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const ImuSample& a, const ImuSample& b) { return a.stamp < b.stamp; });
  return samples;
}
}  // namespace

std::vector<ImuSample> readOusterImu(Bytes packet, const OusterLayout& layout)
{
  switch (layout.imu_profile)
  {
    case OusterImuProfile::Legacy:
      return readLegacy(packet);
    case OusterImuProfile::Accel32Gyro32Nmea:
      return readAccelGyro(packet, layout);
    case OusterImuProfile::Off:
      break;
  }
  return {};
}
}  // namespace scanloom
