/** Options of each simulated lidar: the unit, its clock, its faults; and of the ranging of all. */
#pragma once
#include "base/config/Values.h"
#include "base/core/Field.h"

#include <string>

namespace scanloom
{
/** Errors of a lidar's rotor and clock. */
struct LidarClockOptions
{
  double rate_error_ppm = 0;  // ppm: how much too slowly its rotor turns
  double clock_offset = 0;
  double clock_drift_ppm = 0;
  double clock_jump = 0;
  double clock_jump_at = 0;
  int first_frame_id = -1;  // frame id of the first frame; 65500 wraps within seconds; -1: random, below 60000

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.clock_offset, Field{"clock_offset", "s", "offset of its stamps; positive: too late", between(-1e6, 1e6)});
    visit(o.clock_drift_ppm, Field{"clock_drift_ppm", "ppm", "how much too fast its clock runs", between(-1000, 1000)});
    visit(o.clock_jump, Field{"clock_jump", "s", "step of its clock at clock_jump_at", between(-1e6, 1e6)});
    visit(o.clock_jump_at, Field{"clock_jump_at", "s", "time of that step after the start; 0: no step", atLeast(0)});
  }
};

/** Faults of a sensor and its cable. Times count from the start of the recording. */
struct LidarFaultOptions
{
  double loss = 0;
  double burst_every = 0;
  double burst_length = 0.02;  // s: length of such a burst
  double reordered = 0;
  double duplicated = 0;
  double silent_from = 0;
  double silent_to = 0;
  double restart_at = 0;
  double restart_takes = 10;  // s: time from the restart until it sends again
  std::string pose_error = "0 0 0 0 0 0";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.loss, Field{"loss", "", "share of its packets that are lost independently of each other", between(0, 1)});
    visit(o.burst_every,
          Field{"burst_every", "s", "mean time between bursts in which all its packets are lost; 0: none", atLeast(0)});
    visit(o.reordered,
          Field{"reordered", "", "share of its packets that arrive after one or two later ones", between(0, 1)});
    visit(o.duplicated, Field{"duplicated", "", "share of its packets that arrive twice", between(0, 1)});
    visit(o.silent_from, Field{"silent_from", "s", "start of the time in which it sends nothing", atLeast(0)});
    visit(o.silent_to,
          Field{"silent_to", "s", "end of that time; if not greater than silent_from, there is none", atLeast(0)});
    visit(o.restart_at, Field{"restart_at", "s",
                              "time of a restart: new init id, frame ids and stamps from zero; 0: none", atLeast(0)});
    visit(o.pose_error, Field{"pose_error", "m deg",
                              "error of the pose that extrinsics.txt gets, in the sensor's frame: x y z yaw "
                              "pitch roll"});
  }
};

struct SimulatedLidarOptions
{
  std::string name;
  std::string model;
  std::string metadata;
  std::string mode;
  std::string profile;
  std::string window;
  std::string pose = "0 0 2.5 0 0 0";
  int port = 0;
  LidarClockOptions clock;
  LidarFaultOptions faults;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.name, Field{"name", "", "name of the lidar in file names and extrinsics.txt"});
    visit(o.model,
          Field{"model", "",
                "OS0, OS1 or OS2 with 8 to 128 beams, OS0-32 for example; beam angles are assumed; empty: as lidar1"});
    visit(o.metadata, Field{"metadata", "", "metadata JSON file of a real sensor, instead of 'model'; empty: none",
                            unbounded(), pathFrom});
    visit(o.mode, Field{"mode", "",
                        "columns per turn and turns per second, 1024x10 for example; empty: the file's, or as lidar1"});
    visit(o.profile,
          Field{"profile", "",
                "Ouster's name of the packet format; empty: the file's, or as lidar1. Ranges have steps of 8 mm in "
                "RNG15, of 1 mm in RNG19 and LEGACY"});
    visit(o.window, Field{"window", "",
                          "azimuth window: first and last column, '0 255'; first > last wraps around 0; "
                          "empty: the whole turn"});
    visit(o.pose, Field{"pose", "m deg", "pose of the sensor on the body: x y z yaw pitch roll"});
    visit(o.port,
          Field{"port", "", "UDP port of its packets; its IMU uses the next one; 0: the file's, or 7502, 7504, ...",
                between(0, 65534)});
    LidarClockOptions::fields(o.clock, visit);
    LidarFaultOptions::fields(o.faults, visit);
  }
};

/** Full angle of a beam; profiles with two returns find the second one within it (an OS0's data sheet, assumed for OS1
 * and OS2, which have 0.18 and 0.09). */
inline constexpr double kBeamDivergenceDeg = 0.35;

/** Reflectivities at 865 nm (assumed). Not keys of the configuration: tests change them. */
struct ReflectivityOptions
{
  double ground = 0.15;      // reflectivity at 865 nm: litter and moss
  double stem = 0.3;         // reflectivity of bark
  double branch = 0.3;       // reflectivity of branches
  double crown = 0.4;        // reflectivity of needles and leaves
  double undergrowth = 0.4;  // reflectivity of shrubs and grass
  double machine = 0.6;      // reflectivity of the painted machine and its boom
  double object = 0.3;       // reflectivity of persons and vehicles
  double building = 0.35;    // reflectivity of plaster and concrete
};

/** Returns of all lidars: range, noise, signal. */
struct RangingOptions
{
  double range_noise = 0.008;  // m: standard deviation of the range of strong returns
  double range_noise_weak =
      0.02;  // m: further standard deviation where half of the returns are lost; it falls with the root of the signal
  double range_at_ten_percent = 0;
  double least_range = 0;  // m: smallest range that is measured; 0: from the data sheet (0.3, 0.5, 1)
  double farthest_range = 50;
  double shade = 0.1;  // standard deviation of a reflectivity, as a share of it
  ReflectivityOptions reflectivity;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.range_at_ten_percent, Field{"range_at_ten_percent", "m",
                                        "range at which half of the returns of 10 % reflectivity are lost: for an OS0 "
                                        "15 in rain, 35 at best; 0: from the data sheet (35, 90, 200)",
                                        between(0, 500)});
    visit(o.farthest_range, Field{"farthest_range", "m", "greatest range that is simulated", between(1, 500)});
  }
};
}  // namespace scanloom
