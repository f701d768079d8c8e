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

/** Called after each event with the share of the input that was read; false stops the run, keeping what there is. */
using KeepGoing = std::function<bool(double progress, std::uint64_t scans)>;

struct SlamRunResult
{
  RunSummary summary;  // counts, stages, outcome: OK, INITIALISING, DEGENERATE, LOST, NOTHING or INTERRUPTED
  bool passed =
      true;  // false: LOST at the end or for more than 5 % of the scans, or not a single pose; as far as it came
};

/**
 * Runs to the end of input and hands every estimate to `files`, which the caller closes with the summary.
 * Throws ConfigError if settings.slam.imu names an IMU that the input does not have, and what requireGravity() does.
 */
SlamRunResult runSlam(SensorInput&, const SlamSettings&, SlamFiles& files, const KeepGoing&, const Warn&);
}  // namespace scanloom
