/**
 * Lidar-inertial localisation in a local map ("A generic multi-lidar data batching strategy on the sensor driver
 * level", EuroCOW 2025, section 2.2). What happens to one scan is in Tracker::step().
 */
#pragma once
#include "estimation/slam/internal/StartUp.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * The map frame: z up, origin and yaw those of the body at the start of the first scan, until enterMap(). The same
 * samples and scans in the same order give the same bits.
 */
class LidarInertialSlam
{
 public:
  /**
   * `lidars` by sensor id; stems are moved onto their axes only for lidars that are given. Throws ConfigError for a
   * [crop] lidar_boxes that does not fit them.
   */
  LidarInertialSlam(const SlamSettings&, const Rigid& body_T_imu, const std::vector<MountedLidar>& lidars);

  /** Samples come in time order, as ImuScreening passes them on; one out of order or not finite is ignored. */
  void addImu(const ImuSample&);

  /** From the newest state on. The local map stays. The biases of the new IMU are computed from those of the old one.
   */
  void changeImu(const ImuChange&);

  /** From the newest state on, estimates are in the frame of an earlier drive's map. There must have been an estimate.
   */
  void enterMap(const MapEntry&);

  /** The estimates that became possible (throws as startUp() does): a scan waits until the IMU covers it, the first
   * ones until the start is known. */
  std::vector<StateEstimate> addScan(Scan);

  /** The estimates that became possible with the IMU samples since the last scan. */
  std::vector<StateEstimate> process() { return processWaiting(); }

  /** At the end of the input: processes the scans that wait, with the samples there are. */
  std::vector<StateEstimate> finish();

  /** The window of states, to compare its covariances with a truth; nullptr before the start. */
  const FixedLagSmoother* smoother() const { return state_ ? &state_->window.smoother : nullptr; }

  const StageTimes& times() const { return times_; }
  std::uint64_t skippedScans() const { return waiting_.skipped(); }
  std::uint64_t recoveries() const { return recoveries_; }
  std::uint64_t mapRestarts() const { return map_restarts_; }

  /** Counts of the scans that are used, by sensor id. */
  const std::vector<CropCounts>& cropped() const { return cropped_; }

 private:
  std::vector<StateEstimate> processWaiting();
  Scan withoutMachine(Scan);
  StateEstimate process(Scan);

  Tracker tracker_;
  Crop crop_;
  StandstillOptions standstill_;
  MountedImu mounted_imu_;
  ImuBuffer imu_;
  WaitingScans waiting_;
  std::optional<TrackerState> state_;  // none before the start
  std::vector<CropCounts> cropped_;
  std::uint64_t recoveries_ = 0, map_restarts_ = 0;
  StageTimes times_;
};
}  // namespace scanloom
