/** The sensors of a machine, with metadata and poses, ready to be read. */
#pragma once
#include "base/formats/ImuCsv.h"
#include "input/batching/TimeBatcher.h"
#include "input/rig/PacketRouter.h"
#include "input/rig/RigOptions.h"
#include "input/rig/internal/RigSensor.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class Ros2Node;

/** How a rig without captures receives. */
struct LiveOptions
{
  std::optional<IpAddress> bind_address;    // none: every address of this computer
  std::size_t receive_buffer = 16'000'000;  // bytes per port, asked of the kernel
  std::size_t scans_waiting = 10;           // at most, if the consumer is slow; then the oldest is dropped
  std::filesystem::path capture;            // file for every datagram or message received; empty: none
  std::shared_ptr<Ros2Node> ros2;           // the sensors' topics are heard there; null: datagrams come to ports
};

struct Rig
{
  std::vector<BatchedLidar> lidars;  // a lidar's place here is its sensor_id; without decoder while it is not known
  std::vector<LidarAddress> addresses;
  std::vector<RigSensor> sensors;
  std::vector<std::filesystem::path> captures;
  std::vector<ImuSample> body_imu;  // as recorded; empty if there is none
  std::string body_imu_topic;       // where they come from, if that is a topic
  std::optional<Rigid> body_T_imu;  // none if the body has no IMU of its own
  BatcherOptions batcher;
  LiveOptions live;
  std::vector<std::string> notes;  // what was concluded about its files
};

/** For a PacketRouter; the rig must outlive it, or its decoders. */
std::vector<RoutedLidar> routesOf(const Rig&);

/**
 * The same rig as it is heard live on the topics by which its recording was described. Throws ConfigError if its lidars
 * have none.
 */
Rig heardOn(std::shared_ptr<Ros2Node>, Rig);

/** Throws ConfigError if two lidars have metadata of one sensor: every packet would be of both or of neither. */
void refuseOneSensorTwice(const Rig&);

/**
 * Reads metadata or asks sensors for them, and reads extrinsics and the body's IMU. `only` names the lidars to use, in
 * any order; empty: all. Throws ConfigError for a name that no lidar has and for a missing pose, and what the readers
 * throw.
 */
Rig makeRig(const RigSettings&, const std::vector<std::string>& only = {});
}  // namespace scanloom
