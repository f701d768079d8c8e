#pragma once
#include "estimation/slam/ImuConsistencyCheck.h"
#include "run/run/internal/LidarCheck.h"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
/** Called with a message that the user should see at once. */
using Warn = std::function<void(const std::string&)>;

/** An IMU on the body or in a lidar. */
struct RigImu
{
  std::string name;  // for messages
  Rigid body_T_imu;
};

/**
 * Compares the IMUs with each other every 15 s, the lidars with each other and the IMU in use with the motion that they
 * see once a minute, and all at the end. Warns once of each sensor. The IMU comes first: where it is at fault for
 * certain, by gravity or by most others, the lidars are not judged, because it placed what they saw. By the lidars'
 * motion it is judged while they agree: lidars that contradict each other give a wrong one.
 */
class RigCheck
{
 public:
  /** `lidars` by sensor id; `imus` by SensorImu::sensor, `in_use` one of them, or none. `warn` must outlive the check.
   */
  RigCheck(std::vector<MountedLidar> lidars, std::map<int, RigImu> imus, std::optional<int> in_use, const Warn& warn);

  /** Of any IMU. */
  void add(int sensor, const ImuSample&);

  /** Runs the checks that are due. */
  void add(const StateEstimate&);

  void check();

  /** The IMU in use is another one from here on. */
  void changeImu(int sensor);

  bool warned() const { return !blamed_.empty(); }

  /** As of the last check. */
  const Findings& lidars() const { return findings_; }
  const std::optional<GyroAgreement>& imu() const { return agreement_; }

 private:
  void checkImus();
  void checkUnits();
  void checkLidars();
  void checkImuInUse();
  void blame(const std::string& sensor, const std::string& why);

  LidarCheck lidars_;
  std::map<int, RigImu> imus_;
  std::map<int, std::deque<ImuSample>> heard_;  // of the last minute
  std::optional<int> in_use_;
  ImuConsistencyCheck consistency_;
  const Warn& warn_;
  std::optional<Timestamp> next_imu_check_, next_check_;
  Findings findings_;
  std::optional<GyroAgreement> agreement_;
  std::set<std::string> blamed_;
  bool imu_in_use_is_wrong_ = false, told_of_crop_ = false;
};
}  // namespace scanloom
