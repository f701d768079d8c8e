#include "simulation/Scene.h"

#include "source/Extrinsics.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr Timestamp kStart{1'750'000'000s};

Rigid poseOption(const std::string& name, const std::string& text)
{
  try
  {
    return parsePose(text);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(fmt::format("[simulated_rig] {}: {}", name, error.what()));
  }
}

LidarTiming drawTiming(const OusterMetadata& metadata, double rate_error_ppm, std::uint64_t seed, RandomStream stream)
{
  Random random(seed, stream, 0);
  const int packets_per_frame = metadata.columns_per_frame / metadata.columns_per_packet;
  LidarTiming timing;
  timing.first_stamp = fromSeconds(random.uniform(0.01, 0.1));
  timing.rate_error_ppm = rate_error_ppm;
  timing.first_measurement_id =
      static_cast<std::uint16_t>(metadata.columns_per_packet * static_cast<int>(random.uniform(0, packets_per_frame)));
  // The right lidar's frame ids wrap soon after the start: what a real recording does once in two hours.
  timing.first_frame_id =
      stream == RandomStream::RightTiming ? 65500 : static_cast<std::uint32_t>(random.uniform(0, 60000));
  return timing;
}

ImuBias drawBias(std::uint64_t seed, std::uint64_t index, double gyro, double accel)
{
  Random random(seed, RandomStream::ImuBiases, index);
  ImuBias bias;
  for (double& axis : bias.gyro) axis = gyro * random.normal();
  for (double& axis : bias.accel) axis = accel * random.normal();
  return bias;
}
}  // namespace

Scene makeScene(const SimulationSettings& settings, std::uint64_t seed)
{
  const Ground ground(settings.ground);
  const Drive drive(Route(settings.drive, settings.work, seed), settings.drive, settings.body, ground);

  const auto lidar = [&](const OusterMetadata& metadata, const Rigid& body_T_sensor, double rate_error_ppm,
                         RandomStream timing, RandomStream noise)
  {
    return SimulatedLidar(metadata, body_T_sensor, drawTiming(metadata, rate_error_ppm, seed, timing),
                          {settings.lidar.range_noise, seed, noise});
  };
  const SimulatedRigOptions& rig = settings.rig;
  const SimulatedLidar left =
      lidar(assumedOs0(settings.lidar, "122150000101", 5431292, 7502), poseOption("left_pose", rig.left_pose),
            rig.left_rate_error_ppm, RandomStream::LeftTiming, RandomStream::LeftLidar);
  const SimulatedLidar right =
      lidar(assumedOs0(settings.lidar, "122150000202", 9266174, 7504), poseOption("right_pose", rig.right_pose),
            rig.right_rate_error_ppm, RandomStream::RightTiming, RandomStream::RightLidar);

  return {seed,
          {kStart, settings.drive.duration},
          World(ground, settings.forest, drive.path(), seed),
          drive,
          {LidarStation{"left", left, RandomStream::LeftTransport, RandomStream::LeftImu},
           LidarStation{"right", right, RandomStream::RightTransport, RandomStream::RightImu}},
          poseOption("imu_pose", rig.imu_pose),
          poseOption("prism_pose", rig.prism_pose),
          {settings.imu, drawBias(seed, 0, 3e-4, 2e-3)}};
}
}  // namespace scanloom
