/** Sensor input through localisation into files. */
#pragma once
#include "mrpt_bridge/SensorInput.h"
#include "output/SlamFiles.h"
#include "slam/LidarInertialSlam.h"

#include <functional>

namespace scanloom
{
/** Called with what a person should know at once. */
using Warn = std::function<void(const std::string&)>;

struct RunProgress
{
  double share = 0;  // of the input that was read, 0 to 1
  std::uint64_t scans = 0;
  double recorded = 0;  // s, from the first pose to the newest
  double busy = 0;      // s, without waiting for input
};

/** Called after each event, and when none came for a while; false stops the run, keeping what there is. */
using KeepGoing = std::function<bool(const RunProgress&)>;

struct SlamRunResult
{
  RunSummary summary;  // counts, stages, outcome: OK, INITIALISING, DEGENERATE, LOST, NOTHING or INTERRUPTED
  /**
   * False: LOST at the end or for more than 5 % of the scans, a map that was given up, so that the trajectory has a
   * break, an IMU at fault, or not a single pose; as far as it came.
   */
  bool passed = true;
};

/**
 * Runs to the end of input and hands every estimate to `files`, which the caller closes with the summary.
 * Throws ConfigError if settings.slam.imu names an IMU that the input does not have, and what requireGravity() does.
 */
SlamRunResult runSlam(SensorInput&, const SlamSettings&, SlamFiles& files, const KeepGoing&, const Warn&);
}  // namespace scanloom
