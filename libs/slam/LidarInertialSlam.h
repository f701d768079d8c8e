/**
 * Lidar-inertial localisation in a local map ("A generic multi-lidar data batching strategy on the sensor driver
 * level", EuroCOW 2025, section 2.2): one page, addScan() to track().
 */
#pragma once
#include "batching/Scan.h"
#include "core/StageTimes.h"
#include "imu/ImuBuffer.h"
#include "slam/Contradiction.h"
#include "slam/SlamSettings.h"
#include "slam/StateEstimate.h"
#include "slam/WindowStart.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/**
 * The map frame: z up, origin and yaw those of the body at the start of the first scan. The same samples and scans in
 * the same order give the same bits.
 */
class LidarInertialSlam
{
 public:
  /** `lidars`: where each is in the body frame, by sensor_id. Of one that is not there stems are taken as they look. */
  LidarInertialSlam(const SlamSettings&, const Rigid& body_T_imu, std::vector<Eigen::Vector3d> lidars,
                    std::vector<LidarBox> = {});

  /** In time order; a sample out of order or not finite is refused and counted. */
  void addImu(const ImuSample&);

  /** From the newest state on. The map stays, and so does what the old one told of the biases of the new one. */
  void changeImu(const ImuChange&);

  /** The estimates that became possible (throws what requireGravity() does at the start): a scan waits until the IMU
   * covers it, the first ones until the start is known.
   */
  std::vector<StateEstimate> addScan(Scan);

  /** No more input: what waits is processed with the samples there are. */
  std::vector<StateEstimate> finish();

  /** The window of states, for whoever asks more of it than an estimate tells; none before the start. */
  const std::optional<FixedLagSmoother>& smoother() const { return smoother_; }

  const StageTimes& times() const { return times_; }
  std::uint64_t refusedImuSamples() const { return refused_imu_samples_; }
  std::uint64_t skippedScans() const { return skipped_scans_; }
  std::uint64_t recoveries() const { return recoveries_; }
  std::uint64_t mapRestarts() const { return map_restarts_; }

  /** Of the scans that were processed, by sensor id. */
  const std::vector<CropCounts>& cropped() const { return cropped_; }

 private:
  /** What was known when a registration was last trusted: before the IMU could bend it. */
  struct Seen
  {
    RegistrationResult registration;
    Rigid map_T_local;
    ImuBias bias;
  };

  std::vector<StateEstimate> processWaiting(bool input_ended);
  bool isCutStart(const Scan&);
  bool start(bool input_ended);
  void begin(const NavEstimate&);
  Eigen::Vector3d velocityOfFirstScans(const ImuInitialisation& at_rest) const;
  bool covered(const Scan&) const;
  StateEstimate track(Scan);
  PointCloud preprocess(Scan, const NavState& at_end, const std::vector<ImuSample>&);
  void locate(const std::vector<View>&, StateEstimate&);
  void addToSmoother(const RegistrationResult&);
  bool recover(const std::vector<View>&, StateEstimate&);
  void anchorAt(const Rigid& local_T_body);
  void restartAt(const Rigid& local_T_body, const Matrix6d& covariance);
  NavEstimate newest() const;
  void updateMap(PointCloud, const std::vector<View>&, StateEstimate&);
  void addKeyframe(PointCloud, const std::vector<View>&, StateEstimate&);
  Health healthOf(const StateEstimate&);
  bool contradicts() const;
  Rigid map_T_local() const;
  Rigid bodyAt(const NavState&) const;

  SlamSettings settings_;
  Rigid body_T_imu_, imu_T_body_;
  std::vector<Eigen::Vector3d> lidars_;
  std::vector<LidarBox> lidar_boxes_;
  ImuBuffer imu_;
  std::deque<Scan> waiting_;
  std::optional<Timestamp> first_start_, last_end_;  // of cut scans before the first whole one; of those that waited
  std::uint64_t scans_seen_ = 0, skipped_scans_ = 0, refused_imu_samples_ = 0, recoveries_ = 0, map_restarts_ = 0;
  std::optional<FixedLagSmoother> smoother_;  // none before the start
  LocalMap local_map_;                        // rigid, in a frame of its own
  Rigid local_T_anchor_;                      // where the smoother's anchor, the first keyframe's state, is in it
  std::optional<Rigid> last_registered_;      // in the local map
  std::optional<Seen> last_seen_;
  Contradiction contradiction_;  // of registrations and IMU
  std::optional<Timestamp> tried_to_recover_;
  bool tried_all_around_ = false;
  std::optional<Timestamp> initialising_until_;
  Timestamp last_trusted_;
  Trajectory way_to_last_;  // from the state before
  std::vector<CropCounts> cropped_;
  StageTimes times_;
};
}  // namespace scanloom
