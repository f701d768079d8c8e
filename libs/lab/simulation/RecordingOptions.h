/** Options of a simulated recording. */
#pragma once
#include "base/config/Schema.h"
#include "lab/simulation/internal/Buildings.h"
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/ForestOptions.h"
#include "lab/simulation/internal/Gnss.h"
#include "lab/simulation/internal/Ground.h"
#include "lab/simulation/internal/Machine.h"
#include "lab/simulation/internal/MovingObjects.h"
#include "lab/simulation/internal/Precipitation.h"
#include "lab/simulation/internal/SimulatedImu.h"
#include "lab/simulation/internal/SimulatedLidarOptions.h"
#include "lab/simulation/internal/TotalStation.h"

#include <string>
#include <vector>

namespace scanloom
{
/** What is written of the lidars. */
struct SimulatedRecordingOptions
{
  std::string whole_turns = "none";

  bool packets() const { return whole_turns == "none"; }

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.whole_turns, Field{"whole_turns", "",
                               "instead of packets a rawlog of whole turns (approach A of the paper): nearest, or "
                               "one_of_each as they end; none: packets"});
  }
};

/** Two OS0 beside the boom, tilted outwards. */
std::vector<SimulatedLidarOptions> dualOs0();

/** A member per section of the configuration, and what only tests change; hence more than a dozen. */
struct SimulationSettings
{
  DriveOptions drive;
  WorkCycleOptions work;
  BodyMotionOptions body;
  MachineParts machine;
  ObjectOptions objects;
  GroundOptions ground;
  SlopeOptions slopes;
  EngineOptions engine;
  PrecipitationOptions precipitation;
  ForestOptions forest;
  BuildingOptions buildings;
  SimulatedRecordingOptions recording;
  std::vector<SimulatedLidarOptions> lidars = dualOs0();
  RangingOptions ranging;
  SimulatedImuOptions imu;
  SimulatedImuOptions lidar_imu = ousterLikeImu();
  TotalStationOptions station;
  GnssOptions gnss;
  Rigid body_T_prism = Rigid::fromXyzYawPitchRoll(-1.1, 0.5, 3.9, 0, 0, 0);

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.drive, Section{"simulated_drive", "how the machine moves"});
    visit(s.work, Section{"simulated_work", "the work cycle of route = work"});
    visit(s.body, Section{"simulated_body", "how the machine's body sways and shakes"});
    visit(s.machine, Section{"simulated_machine", "the machine"});
    visit(s.objects, Section{"simulated_objects", "what moves around the machine"});
    visit(s.engine, Section{"simulated_engine", "vibration by the engine, also at rest"});
    visit(s.ground, Section{"simulated_ground", "the ground"});
    visit(s.slopes, Section{"simulated_slopes", "slopes of the ground"});
    visit(s.precipitation, Section{"simulated_precipitation", "rain and snow between the lidars and the world"});
    ForestOptions::sections(s.forest, visit);
    visit(s.buildings, Section{"simulated_buildings", "what people built"});
    visit(s.recording, Section{"simulated_recording", "what is written of the lidars"});
    visit(s.lidars, Section{"simulated_lidars", "any number of lidars: lidar1_, lidar2_, ...", "lidar"});
    visit(s.ranging, Section{"simulated_ranging", "ranging of all lidars: returns, noise, reflectivities"});
    visit(s.station, Section{"simulated_total_station", "the total station that tracks the prism"});
    visit(s.gnss, Section{"simulated_gnss", "a receiver of GNSS whose antenna is where the prism is"});
  }
};
}  // namespace scanloom
