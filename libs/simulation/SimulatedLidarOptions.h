/** What can be chosen about each simulated lidar: the unit, its clock, and what goes wrong with it. */
#pragma once
#include "core/Field.h"

#include <string>

namespace scanloom
{
/** A lidar's clock against the true time by which the world moves. */
struct LidarClockOptions
{
  double rate_error_ppm = 0;
  double clock_offset = 0;
  double clock_drift_ppm = 0;
  double clock_jump = 0;
  double clock_jump_at = 0;
  int first_frame_id = -1;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.rate_error_ppm, Field{"rate_error_ppm", "ppm", "its rotor turns so much too slowly", between(-1000, 1000)});
    visit(o.clock_offset, Field{"clock_offset", "s", "its stamps are so much too late", between(-1e6, 1e6)});
    visit(o.clock_drift_ppm, Field{"clock_drift_ppm", "ppm", "its stamps run so much too fast", between(-1000, 1000)});
    visit(o.clock_jump, Field{"clock_jump", "s", "its stamps jump by so much", between(-1e6, 1e6)});
    visit(o.clock_jump_at, Field{"clock_jump_at", "s", "after the start; 0: they never jump", atLeast(0)});
    visit(o.first_frame_id,
          Field{"first_frame_id", "", "65500 wraps within seconds; -1: at random, below 60000", between(-1, 65535)});
  }
};

/** Faults of a sensor and of its cable. Times count from the start of the recording. */
struct LidarFaultOptions
{
  double loss = 0;
  double burst_every = 0;
  double burst_length = 0.02;
  double reordered = 0;
  double duplicated = 0;
  double silent_from = 0;
  double silent_to = 0;
  double restart_at = 0;
  double restart_takes = 10;
  std::string pose_error = "0 0 0 0 0 0";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.loss, Field{"loss", "", "share of its packets that are lost, each by itself", between(0, 1)});
    visit(o.burst_every, Field{"burst_every", "s", "mean time between bursts of loss; 0: none", atLeast(0)});
    visit(o.burst_length, Field{"burst_length", "s", "how long all its packets are lost then", atLeast(0)});
    visit(o.reordered,
          Field{"reordered", "", "share of its packets that come after one or two later ones", between(0, 1)});
    visit(o.duplicated, Field{"duplicated", "", "share of its packets that come twice", between(0, 1)});
    visit(o.silent_from, Field{"silent_from", "s", "it sends nothing from here on", atLeast(0)});
    visit(o.silent_to, Field{"silent_to", "s", "until here; not above silent_from: it is never silent", atLeast(0)});
    visit(o.restart_at, Field{"restart_at", "s",
                              "it starts anew: other init id, frame ids and stamps from zero; 0: never", atLeast(0)});
    visit(o.restart_takes, Field{"restart_takes", "s", "until it sends again (assumed)", atLeast(0)});
    visit(o.pose_error, Field{"pose_error", "m deg",
                              "the extrinsics that are written differ by this from the true pose, in the sensor's "
                              "own frame: x y z yaw pitch roll"});
  }
};

/** From a lidar to the recording computer's stamp. */
struct NetworkOptions
{
  double delay = 60e-6;
  double jitter = 80e-6;
  double rare_jitter = 2e-3;
  double rare_share = 0.003;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.delay, Field{"delay", "s", "from a packet's last measurement to its receipt (assumed)", between(0, 0.1)});
    visit(o.jitter, Field{"jitter", "s", "up to so much more, all delays alike (assumed)", between(0, 0.1)});
    visit(o.rare_jitter,
          Field{"rare_jitter", "s", "up to so much more when the computer is busy, but no packet overtakes (assumed)",
                between(0, 0.1)});
    visit(o.rare_share, Field{"rare_share", "", "of the packets, for which it is busy (assumed)", between(0, 1)});
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
    visit(o.name, Field{"name", "", "of its files and in the extrinsics"});
    visit(o.model,
          Field{"model", "", "OS0, OS1 or OS2 and its beams, 8 to 128, with assumed tables; empty: as lidar1"});
    visit(o.metadata, Field{"metadata", "", "a sensor's own metadata JSON file, in place of 'model'; empty: none"});
    visit(o.mode, Field{"mode", "", "columns per turn and turns per second, 1024x10; empty: the file's, or as lidar1"});
    visit(o.profile,
          Field{"profile", "",
                "layout of its packets, by Ouster's name; empty: the file's, or as lidar1. RNG15 has steps of "
                "8 mm, RNG19 and LEGACY of 1 mm"});
    visit(o.window, Field{"window", "",
                          "first and last column that it sends, '0 255'; first > last wraps around 0; "
                          "empty: the whole turn"});
    visit(o.pose, Field{"pose", "m deg", "sensor frame in the body frame: x y z yaw pitch roll"});
    visit(o.port,
          Field{"port", "", "UDP port of its packets, its IMU's is the next one; 0: the file's, or 7502, 7504, ...",
                between(0, 65534)});
    LidarClockOptions::fields(o.clock, visit);
    LidarFaultOptions::fields(o.faults, visit);
  }
};

/** What comes back from a surface; the same for all lidars. */
struct RangingOptions
{
  double range_noise = 0.008;
  double range_noise_weak = 0.02;
  double range_at_ten_percent = 0;
  double least_range = 0;
  double farthest_range = 50;
  double beam_divergence_deg = 0.35;
  double least_separation = 0.5;
  double shade = 0.1;
  double photons = 25;
  double daylight = 1200;
  double sky = 900;
  double ground = 0.15;
  double stem = 0.3;
  double branch = 0.3;
  double crown = 0.4;
  double undergrowth = 0.4;
  double machine = 0.6;
  double object = 0.3;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.range_noise,
          Field{"range_noise", "m", "standard deviation of the range of a strong return", between(0, 0.2)});
    visit(o.range_noise_weak, Field{"range_noise_weak", "m",
                                    "added in squares where half of the returns are lost; falls with the root of the "
                                    "signal (assumed)",
                                    between(0, 0.5)});
    visit(o.range_at_ten_percent, Field{"range_at_ten_percent", "m",
                                        "where half of the returns of 10 % reflectivity are lost: 15 in rain to 35 for "
                                        "an OS0; 0: the model's data sheet (35, 90, 200)",
                                        between(0, 500)});
    visit(o.least_range,
          Field{"least_range", "m", "nothing nearer returns; 0: the model's data sheet (0.3, 0.5, 1)", between(0, 10)});
    visit(o.farthest_range, Field{"farthest_range", "m", "no ray is followed farther", between(1, 500)});
    visit(o.beam_divergence_deg, Field{"beam_divergence_deg", "deg",
                                       "full angle of a beam, within which profiles of two returns look for the second "
                                       "(assumed: an OS0's data sheet; OS1 and OS2 0.18, 0.09)",
                                       between(0, 2)});
    visit(o.least_separation,
          Field{"least_separation", "m", "two returns of a beam are this far apart, or one (assumed)", between(0, 10)});
    visit(o.shade,
          Field{"shade", "", "standard deviation of each reflectivity, share of it (assumed)", between(0, 0.5)});
    visit(o.photons, Field{"photons", "", "signal where half of the returns are lost (assumed)", above(0)});
    visit(o.daylight, Field{"daylight", "", "near infrared of a white surface under trees (assumed)", atLeast(0)});
    visit(o.sky, Field{"sky", "", "near infrared where nothing is met (assumed)", atLeast(0)});
    visit(o.ground, Field{"ground", "", "reflectivity at 865 nm: litter and moss (assumed)", between(0, 1)});
    visit(o.stem, Field{"stem", "", "reflectivity of bark (assumed)", between(0, 1)});
    visit(o.branch, Field{"branch", "", "reflectivity of branches (assumed)", between(0, 1)});
    visit(o.crown, Field{"crown", "", "reflectivity of needles and leaves (assumed)", between(0, 1)});
    visit(o.undergrowth, Field{"undergrowth", "", "reflectivity of shrubs and grass (assumed)", between(0, 1)});
    visit(o.machine, Field{"machine", "", "reflectivity of the painted machine and its boom (assumed)", between(0, 1)});
    visit(o.object, Field{"object", "", "reflectivity of persons and vehicles (assumed)", between(0, 1)});
  }
};
}  // namespace scanloom
