/** Sensor input through localisation. */
#pragma once
#include "diagnosis/RigCheck.h"
#include "estimation/slam/LidarInertialSlam.h"
#include "input/rig/SensorInput.h"
#include "run/run/GivenMap.h"
#include "run/run/internal/RunSummary.h"

#include <functional>

namespace scanloom
{
struct RunProgress
{
  double share = 0;  // of the input that was read, 0 to 1
  std::uint64_t scans = 0;
  double recorded = 0;                  // s, from the first pose to the newest
  double busy = 0;                      // s, without waiting for input
  std::optional<Duration> found_after;  // from the first pose until the drive was found in the map given
};

/** Called after each event, and when none came for 0.1 s; false stops the run and keeps what was processed. */
using KeepGoing = std::function<bool(const RunProgress&)>;

/** Called with every estimate, in the order of time. */
using SeeEstimate = std::function<void(const StateEstimate&)>;

/** Called with every event that a person marked, before the estimate of the scan in which it lies. */
using SeeMark = std::function<void(const EventMark&)>;

struct SlamRunResult
{
  /**
   * Counts, stages, and the outcome: OK, LIDAR MISSING (OK, but a lidar is in no scan), IMU MISSING (OK,
   * but the samples of an IMU are of another time than all scans), INITIALISING, DEGENERATE, LOST, MAP JUMPED,
   * RIG NOT FIT (OK, but a lidar or the IMU is at fault), NOT IN MAP (never found in the map given), NOTHING (no pose
   * was measured), INTERRUPTED or FAILED.
   */
  RunSummary summary;
  /**
   * False if no pose was measured, if the map jumped (StateEstimate::mapJumped), if the state was LOST at the end, if
   * more than 5 % of the poses are DEGENERATE or LOST, if the local map was started anew (the trajectory has a break),
   * if it was not found in the map given, if a lidar is in no scan, or if a lidar or the IMU is at fault (RigCheck).
   */
  bool passed = true;
  bool with_imu = false;  // else constant velocity and turn rate were assumed
};

/**
 * Runs to the end of the input. Throws ConfigError if settings.slam.imu names an IMU that the input does not have, and
 * what requireGravity() throws.
 *
 * Whatever else the input or the localisation throws ends the run: the outcome is FAILED, the summary tells the error
 * and the counts, and the estimates so far are kept. Before the first scan there is nothing to keep, and it is thrown
 * on.
 *
 * A scan waits in LidarInertialSlam and nowhere else, by one rule: it is processed as soon as the IMU in use covers it,
 * or when a scan arrives that ends ImuInUse::patience() later. By then, if the IMU is silent and another one is not,
 * that one has taken over, and the scan is processed with its samples.
 *
 * With a map, the drive is searched in it, keyframe by keyframe and beside the run, until it is found, and again where
 * it was LOST for so long that a new map began. From there on, estimates are in the map's frame.
 */
SlamRunResult runSlam(
    SensorInput&, const SlamSettings&, const SeeEstimate&, const KeepGoing&, const Warn&,
    const SeeMark& = [](const EventMark&) {}, const GivenMap& = {});
}  // namespace scanloom
