/** A world, a drive through it and the sensors that go along: everything that a recording is made of. */
#pragma once
#include "simulation/RecordingOptions.h"
#include "simulation/SimulatedImu.h"
#include "simulation/SimulatedLidar.h"
#include "simulation/World.h"

#include <array>
#include <cstdint>
#include <string>

namespace scanloom
{
struct LidarStation
{
  std::string name;
  SimulatedLidar lidar;
  RandomStream transport;  // of the packets
  RandomStream imu;        // of the built-in IMU
};

struct Scene
{
  std::uint64_t seed;
  RecordingSpan span;
  World world;
  Drive drive;
  std::array<LidarStation, 2> lidars;  // left, right
  Rigid body_T_imu;
  Rigid body_T_prism;
  ImuErrors imu_errors;
};

/** Throws std::invalid_argument naming the option that cannot be. */
Scene makeScene(const SimulationSettings&, std::uint64_t seed);
}  // namespace scanloom
