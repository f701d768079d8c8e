/** The sensors of a machine as a run uses them. */
#pragma once
#include "batching/TimeBatcher.h"
#include "source/EurocImu.h"
#include "source/PacketRouter.h"
#include "source/RigOptions.h"
#include "source/RigSensor.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** How a rig without captures receives. */
struct LiveOptions
{
  std::optional<IpAddress> bind_address;    // none: every address of this computer
  std::size_t receive_buffer = 16'000'000;  // bytes per port, asked of the kernel
  std::size_t scans_waiting = 10;           // for a consumer that is late; then the oldest scan is dropped
  std::filesystem::path capture;            // where every datagram is written; empty: nowhere
};

struct Rig
{
  std::vector<BatchedLidar> lidars;  // a lidar's place here is its sensor_id; without decoder while it is not known
  std::vector<LidarAddress> addresses;
  std::vector<RigSensor> sensors;
  std::vector<std::filesystem::path> captures;
  std::vector<ImuSample> body_imu;  // empty if there is none
  Rigid body_T_imu;
  BatcherOptions batcher;
  LiveOptions live;
};

/**
 * Reads or asks for metadata, reads extrinsics and the body's IMU. `only` names the lidars to use, in any order; empty
 * means all. Throws ConfigError for a name that no lidar has and a pose that is given nowhere, and what the readers
 * throw.
 */
Rig makeRig(const RigSettings&, const std::vector<std::string>& only = {});
}  // namespace scanloom
