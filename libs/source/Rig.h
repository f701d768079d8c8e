/** The sensors of a machine as a run uses them, and their recorded packets as one stream in time order. */
#pragma once
#include "batching/ImuOrder.h"
#include "batching/TimeBatcher.h"
#include "source/EurocImu.h"
#include "source/MergedCaptures.h"
#include "source/PacketRouter.h"
#include "source/RigOptions.h"

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scanloom
{
struct Rig
{
  std::vector<BatchedLidar> lidars;  // a lidar's place here is its sensor_id
  std::vector<LidarAddress> addresses;
  std::vector<std::filesystem::path> captures;
  std::vector<ImuSample> body_imu;  // empty if there is none
  Rigid body_T_imu;
  BatcherOptions batcher;
};

/**
 * Reads metadata, extrinsics and the body's IMU. `only` names the lidars to use, in any order; empty means all.
 * Throws ConfigError for a name that no lidar has and a pose that is given nowhere, and what the readers throw.
 */
Rig makeRig(const RigSettings&, const std::vector<std::string>& only = {});

/** What a rig yields: IMU samples and scans; both in time order, the IMU up to one deadline behind. */
using SensorEvent = std::variant<Scan, SensorImu>;

/** A rig's captures through the batcher. */
class RigReplay
{
 public:
  explicit RigReplay(const Rig&);

  /** Nothing at the end of input. */
  std::optional<SensorEvent> next();

  double progress() const { return captures_.progress(); }
  const TimeBatcher& batcher() const { return batcher_; }
  const PacketRouter& router() const { return router_; }
  CaptureCounters captureCounters() const { return captures_.counters(); }
  std::uint64_t lateImuSamples() const { return imu_order_.late(); }

 private:
  void take(const Datagram&);
  void release(std::vector<Scan> scans, Timestamp horizon);

  std::vector<BatchedLidar> lidars_;
  std::vector<ImuSample> body_imu_;
  std::size_t next_body_imu_ = 0;
  MergedCaptures captures_;
  PacketRouter router_;
  TimeBatcher batcher_;
  Duration imu_patience_;
  ImuOrder imu_order_;
  Datagram datagram_;
  std::deque<SensorEvent> waiting_;
  bool ended_ = false;
};
}  // namespace scanloom
