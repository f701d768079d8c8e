#pragma once
#include "estimation/slam/ImuConsistencyCheck.h"
#include "run/run/internal/LidarCheck.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
/** Called with a message that the user should see at once. */
using Warn = std::function<void(const std::string&)>;

/**
 * Compares the lidars with each other, and the IMU in use with the motion that they see, once a minute and at the end.
 * Warns once of each lidar and once of the IMU; of the IMU only while the lidars agree, because lidars that contradict
 * each other give a wrong motion.
 */
class RigCheck
{
 public:
  /** `lidars` by sensor id. `warn` must outlive the check. */
  RigCheck(std::vector<MountedLidar> lidars, const Rigid& body_T_imu, const Warn& warn)
    : lidars_(std::move(lidars)), imu_(body_T_imu), warn_(warn)
  {
  }

  void add(const ImuSample& sample) { imu_.add(sample); }

  /** Runs the check if a minute has passed since the last one. */
  void add(const StateEstimate&);

  void check();

  /** The samples are another IMU's from here on. */
  void changeImu(const Rigid& body_T_imu) { imu_ = ImuConsistencyCheck(body_T_imu); }

  bool warned() const { return !blamed_lidars_.empty() || imu_blamed_; }

  /** As of the last check. */
  const Findings& lidars() const { return findings_; }
  const std::optional<GyroAgreement>& imu() const { return agreement_; }

 private:
  void checkLidars();
  void checkImu();

  LidarCheck lidars_;
  ImuConsistencyCheck imu_;
  const Warn& warn_;
  std::optional<Timestamp> next_check_;
  Findings findings_;
  std::optional<GyroAgreement> agreement_;
  std::set<std::string> blamed_lidars_;
  bool imu_blamed_ = false;
};
}  // namespace scanloom
