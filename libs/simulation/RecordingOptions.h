/** All that can be chosen about a simulated recording. */
#pragma once
#include "config/Schema.h"
#include "imu/Preintegration.h"
#include "simulation/AssumedOs0.h"
#include "simulation/Drive.h"
#include "simulation/ForestOptions.h"
#include "simulation/Ground.h"

#include <string>

namespace scanloom
{
/** Poses on the body as "x y z yaw pitch roll", m and degrees. */
struct SimulatedRigOptions
{
  std::string left_pose = "1.5 1.2 2.5 30 15 -25";
  std::string right_pose = "1.5 -1.2 2.5 -30 15 25";
  std::string imu_pose = "0.1 -0.3 2.8 90 1.2 -0.8";
  std::string prism_pose = "-1.1 0.5 3.9 0 0 0";
  double left_rate_error_ppm = -40;
  double right_rate_error_ppm = 35;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.left_pose, Field{"left_pose", "m deg", "of the left lidar: x y z yaw pitch roll"});
    visit(o.right_pose, Field{"right_pose", "m deg", "of the right lidar"});
    visit(o.imu_pose, Field{"imu_pose", "m deg", "of the body's IMU"});
    visit(o.prism_pose, Field{"prism_pose", "m deg", "of the total station's prism"});
    visit(o.left_rate_error_ppm,
          Field{"left_rate_error_ppm", "ppm", "the left lidar turns so much too slowly", between(-1000, 1000)});
    visit(o.right_rate_error_ppm,
          Field{"right_rate_error_ppm", "ppm", "the right lidar turns so much too slowly", between(-1000, 1000)});
  }
};

struct SimulationSettings
{
  DriveOptions drive;
  WorkCycleOptions work;
  BodyMotionOptions body;
  GroundOptions ground;
  ForestOptions forest;
  SimulatedRigOptions rig;
  Os0Options lidar;
  ImuNoise imu;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.drive, Section{"simulated_drive", "how the machine moves"});
    visit(s.work, Section{"simulated_work", "what it does on route = work"});
    visit(s.body, Section{"simulated_body", "how its body sways and shakes"});
    visit(s.ground, Section{"simulated_ground", "what it drives on"});
    ForestOptions::sections(s.forest, visit);
    visit(s.rig, Section{"simulated_rig", "where the sensors sit"});
    visit(s.lidar, Section{"simulated_lidar", "both lidars"});
    visit(s.imu, Section{"simulated_imu", "the body's IMU"});
  }
};
}  // namespace scanloom
