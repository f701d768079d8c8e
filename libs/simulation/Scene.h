/** A world, a drive through it and the sensors that go along: everything that a recording is made of. */
#pragma once
#include "simulation/RecordingOptions.h"
#include "simulation/Scenery.h"
#include "simulation/SimulatedImu.h"
#include "simulation/SimulatedLidar.h"
#include "simulation/TotalStation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/** A lidar from one start to the next, or to the end. */
struct LidarRun
{
  SimulatedLidar lidar;
  Timestamp until;  // true time; what it measures later is never sent
  ImuSetup imu;     // its built-in one
};

struct LidarStation
{
  std::string name;
  std::uint64_t place = 0;     // in the list of lidars
  std::vector<LidarRun> runs;  // at least one; another one after a restart
  LidarFaultOptions faults;
  Rigid written_body_T_sensor;  // what the extrinsics say

  const OusterMetadata& metadata() const { return runs.front().lidar.metadata(); }
};

struct Scene
{
  std::uint64_t seed;
  RecordingSpan span;
  Scenery scenery;
  std::vector<LidarStation> lidars;
  NetworkOptions network;
  ImuSetup body_imu;
  TotalStation station;
  Rigid body_T_prism;
};

/** Throws std::invalid_argument naming the option that cannot be. */
Scene makeScene(const SimulationSettings&, std::uint64_t seed);
}  // namespace scanloom
