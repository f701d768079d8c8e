/** What `slam` asks of its rig while it runs: the findings of `doctor`, in the same words. */
#pragma once
#include "base/core/Finding.h"
#include "base/core/ImuSample.h"
#include "base/core/StampedPose.h"
#include "diagnosis/internal/LidarCheck.h"
#include "estimation/imu/GyroAgreement.h"

#include <deque>
#include <functional>
#include <future>
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
  Rigid configured_pose;  // of the IMU, or of the lidar that holds it
};

/** What the check keeps of a scan that was localised. */
struct LocalisedScan
{
  Timestamp stamp;
  std::optional<Rigid> registered;     // local_map_T_body, by a registration that is trusted; without the IMU
  const Keyframe* keyframe = nullptr;  // null: the scan is none, or its pose still drifts
};

/** What the rig showed in the last minute. */
struct RigMinute
{
  std::map<int, RigImu> imus;
  std::map<int, std::vector<ImuSample>> samples;
  std::optional<int> in_use;
  std::vector<BodyTurn> turns;  // between registrations
  LidarCheck lidars;
  bool blamed = false;  // a sensor, before
};

struct RigFault
{
  std::string sensor;  // for messages
  Finding finding;
};

/** What is wrong with the rig by a minute. */
struct RigFaults
{
  std::vector<RigFault> faults;
  Findings lidars;
  std::optional<GyroAgreement> imu;
  bool imu_in_use_is_wrong = false;
};

/**
 * Compares the IMUs with gravity and with each other. The IMU comes first: where the one in use is at fault for
 * certain, by gravity or by most others, the lidars are not judged, because it placed what they saw.
 */
RigFaults imuFaults(const RigMinute&);

/** Also the lidars with each other, and the IMU in use with the motion that they see while they agree: lidars that
 * contradict each other give a wrong one. */
RigFaults rigFaults(const RigMinute&);

/**
 * Examines the IMUs every 15 s, all once a minute and at the end, beside the run. What it finds is reported 5 s later,
 * by the scans' time, so that it does not depend on threads. Warns once of each sensor.
 */
class RigCheck
{
 public:
  /** `lidars` by sensor id; `imus` by SensorImu::sensor, `in_use` one of them, or none. `warn` must outlive the check.
   */
  RigCheck(std::vector<MountedLidar> lidars, std::map<int, RigImu> imus, std::optional<int> in_use, const Warn& warn);

  /** Takes a sample of any IMU of the rig; those of others, and those that are not finite or out of order, are left
   * out. */
  void add(int sensor, const ImuSample&);

  /** Takes a scan as it was measured. */
  void add(const Scan& scan) { lidars_.add(scan); }

  /** Takes a localised scan; they must come in the order of time. Starts the examination that is due, and tells what is
   * ready. */
  void add(const LocalisedScan&);

  /** Examines everything once more, at the end of a run. */
  void finish();

  /** The IMU in use is another one from here on. */
  void changeImu(int sensor);

  bool warned() const { return !blamed_.empty(); }

  /** The findings that were reported last. */
  const Findings& lidars() const { return lidars_told_; }
  const std::optional<GyroAgreement>& imu() const { return imu_told_; }

 private:
  void addTurn(const LocalisedScan&);
  RigMinute minute() const;
  void tellPending();
  void tell(const RigFaults&);

  std::map<int, RigImu> imus_;
  std::optional<int> in_use_;
  std::map<int, std::deque<ImuSample>> samples_;  // of the last minute, as all here
  std::deque<BodyTurn> turns_;
  std::optional<StampedPose> last_registered_;
  LidarCheck lidars_;

  const Warn& warn_;
  std::optional<Timestamp> next_;
  std::size_t examinations_ = 0;
  std::future<RigFaults> pending_;
  Timestamp told_at_;
  bool imu_in_use_is_wrong_ = false, told_of_crop_ = false;
  std::set<std::string> blamed_;
  Findings lidars_told_;
  std::optional<GyroAgreement> imu_told_;
};
}  // namespace scanloom
