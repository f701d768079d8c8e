/** All that can be chosen about a simulated recording. */
#pragma once
#include "config/Schema.h"
#include "simulation/Drive.h"
#include "simulation/ForestOptions.h"
#include "simulation/Ground.h"
#include "simulation/Machine.h"
#include "simulation/MovingObjects.h"
#include "simulation/SimulatedImu.h"
#include "simulation/SimulatedLidarOptions.h"
#include "simulation/TotalStation.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Poses on the body as "x y z yaw pitch roll", m and degrees. */
struct SimulatedRigOptions
{
  std::string imu_pose = "0.1 -0.3 2.8 90 1.2 -0.8";
  std::string prism_pose = "-1.1 0.5 3.9 0 0 0";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.imu_pose, Field{"imu_pose", "m deg", "of the body's IMU: x y z yaw pitch roll"});
    visit(o.prism_pose, Field{"prism_pose", "m deg", "of the total station's prism"});
  }
};

/** Two OS0 beside the boom, tilted outwards. */
std::vector<SimulatedLidarOptions> dualOs0();

struct SimulationSettings
{
  DriveOptions drive;
  WorkCycleOptions work;
  BodyMotionOptions body;
  MachineOptions machine;
  BoomOptions boom;
  ObjectOptions objects;
  GroundOptions ground;
  ForestOptions forest;
  SimulatedRigOptions rig;
  std::vector<SimulatedLidarOptions> lidars = dualOs0();
  RangingOptions ranging;
  NetworkOptions network;
  SimulatedImuOptions imu;
  SimulatedImuOptions lidar_imu = ousterLikeImu();
  TotalStationOptions station;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.drive, Section{"simulated_drive", "how the machine moves"});
    visit(s.work, Section{"simulated_work", "what it does on route = work"});
    visit(s.body, Section{"simulated_body", "how its body sways and shakes"});
    visit(s.machine, Section{"simulated_machine", "what the lidars see of it"});
    visit(s.boom, Section{"simulated_boom", "its crane"});
    visit(s.objects, Section{"simulated_objects", "who passes by, and trees that fall"});
    visit(s.ground, Section{"simulated_ground", "what it drives on"});
    ForestOptions::sections(s.forest, visit);
    visit(s.rig, Section{"simulated_rig", "where the other sensors sit"});
    visit(s.lidars, Section{"simulated_lidars", "any number of lidars: lidar1_, lidar2_, ...", "lidar"});
    visit(s.ranging, Section{"simulated_ranging", "what comes back to all lidars"});
    visit(s.network, Section{"simulated_network", "what lies between the lidars and the computer"});
    visit(s.imu, Section{"simulated_imu", "the body's IMU"});
    visit(s.lidar_imu, Section{"simulated_lidar_imu", "the IMUs inside the lidars"});
    visit(s.station, Section{"simulated_total_station", "what tracks the prism"});
  }
};
}  // namespace scanloom
