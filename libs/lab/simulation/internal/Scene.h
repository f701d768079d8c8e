/** Everything that a recording is made of: a world, a drive through it, and the sensors. */
#pragma once
#include "lab/simulation/RecordingOptions.h"
#include "lab/simulation/internal/Scenery.h"
#include "lab/simulation/internal/SimulatedImu.h"
#include "lab/simulation/internal/SimulatedLidar.h"
#include "lab/simulation/internal/TotalStation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/** A lidar from one start to its next restart, or to the end of the recording. */
struct LidarRun
{
  SimulatedLidar lidar;
  Timestamp until;  // true time; later measurements are never sent
  ImuSetup imu;     // its built-in one
};

struct LidarStation
{
  std::string name;
  std::uint64_t place = 0;     // in the list of lidars
  std::vector<LidarRun> runs;  // one, and a second one after a restart
  LidarFaultOptions faults;
  Rigid written_body_T_sensor;  // as extrinsics.txt has it: with [simulated_lidars] pose_error

  const OusterMetadata& metadata() const { return runs.front().lidar.metadata(); }
};

struct Scene
{
  std::uint64_t seed;
  RecordingSpan span;
  Scenery scenery;
  std::vector<LidarStation> lidars;
  ImuSetup body_imu;
  TotalStation station;
  GnssOptions gnss;
  Rigid body_T_prism;
};

/** Throws std::invalid_argument that names a wrong option. */
Scene makeScene(const SimulationSettings&, std::uint64_t seed);
}  // namespace scanloom
