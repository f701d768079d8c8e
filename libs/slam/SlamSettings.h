/** Everything that can be set about localisation, section by section. */
#pragma once
#include "config/Schema.h"
#include "graph/FixedLagSmoother.h"
#include "imu/ImuInitialisation.h"
#include "imu/Preintegration.h"
#include "ndt/Registration.h"
#include "preprocessing/Crop.h"
#include "slam/LocalMap.h"

#include <string>

namespace scanloom
{
struct SlamOptions
{
  int every_nth = 1;
  std::string imu = "auto";
  bool constant_motion = false;
  double imu_delay_ms = 0;
  double imu_wait_ms = 50;
  double lost_after = 2.0;
  bool refine = true;
  bool stem_axes = true;
  bool relative = true;
  double correlation = 2.0;
  double gate = 40.0;
  double contradiction = 9.0;
  double restart_after = 10.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.every_nth, Field{"every_nth", "", "only every N-th scan is used; the IMU always is", atLeast(1)});
    visit(
        o.imu,
        Field{
            "imu", "",
            "body, the name of a lidar (its own IMU), or auto: the body's if there is one, else the first lidar's, and "
            "another one where that falls silent"});
    visit(
        o.constant_motion,
        Field{"constant_motion", "",
              "for comparison: the IMU serves the start alone, then velocity and turn rate are taken to stay what they "
              "were, as surely as [imu_noise] says"});
    visit(o.imu_delay_ms, Field{"imu_delay_ms", "ms",
                                "by how much the IMU's stamps are later than the lidars', which slam tells at its end",
                                between(-500, 500)});
    visit(o.imu_wait_ms, Field{"imu_wait_ms", "ms", "how long a scan waits for the IMU to cover its end", atLeast(0)});
    visit(o.refine, Field{"refine", "", "align every scan again with [fine_cells] after the rough alignment"});
    visit(o.stem_axes,
          Field{"stem_axes", "", "stems and poles are registered by their axes, not by the side that the lidars see"});
    visit(o.relative, Field{"relative", "",
                            "a registration measures from the first keyframe, whose attitude gravity may still turn; "
                            "false: from the map, as the paper does"});
    visit(o.correlation, Field{"correlation", "m",
                               "registrations err together over so much travel: so many count as one", atLeast(0)});
    visit(o.gate, Field{"gate", "sigma", "a registration farther from what the IMU predicts is not trusted; 0: all are",
                        atLeast(0)});
    visit(o.contradiction,
          Field{"contradiction", "sigma",
                "registrations and IMU so far apart in the median over ten seconds: the state is LOST; 0: never",
                atLeast(0)});
    visit(o.restart_after,
          Field{"restart_after", "s", "LOST for so long, a new local map begins where the IMU says", atLeast(0)});
    visit(o.lost_after,
          Field{"lost_after", "s", "without a trustworthy registration for so long the state is LOST", above(0)});
  }
};

struct SlamSettings
{
  SlamOptions slam;
  StandstillOptions start;
  ImuNoise imu;
  ImuNoise lidar_imu = insideLidar();
  CropOptions crop;
  NdtOptions scan_cells = cells(2.5);
  NdtOptions fine_cells = thinned(farCells(1.0));
  NdtOptions map_cells = farCells(1.0);
  NdtOptions keyframe_cells = thinned(farCells(0.5));
  RegistrationOptions rough = reach(0.3);
  RegistrationOptions fine = reach(1.0);
  LocalMapOptions local_map;
  SmootherOptions smoother;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.slam, Section{"slam", "lidar-inertial localisation"});
    visit(s.start, Section{"start", "the first attitude and gyro bias, from standstill"});
    visit(s.imu, Section{"imu_noise", "how far the body's IMU is trusted"});
    visit(s.lidar_imu, Section{"lidar_imu_noise", "the same of an IMU inside a lidar, where it is the one in use"});
    visit(s.crop, Section{"crop", "the machine's own points, and the ranges that are used"});
    visit(s.scan_cells, Section{"scan_cells", "NDT cells of a scan for the rough alignment"});
    visit(s.fine_cells, Section{"fine_cells", "NDT cells of a scan for the fine alignment"});
    visit(s.map_cells, Section{"map_cells", "NDT cells of the local map"});
    visit(s.keyframe_cells, Section{"keyframe_cells", "NDT cells of a scan that becomes a keyframe"});
    visit(s.rough, Section{"rough_registration", "a scan to the local map, from the IMU's prediction"});
    visit(s.fine, Section{"fine_registration", "the same again from there, with finer cells and a narrower score"});
    visit(s.local_map, Section{"local_map", "the keyframes that a scan is aligned to"});
    visit(s.smoother, Section{"smoother", "the window of states"});
  }

 private:
  /** A consumer's chip, as Ouster's are (assumed). */
  static ImuNoise insideLidar()
  {
    ImuNoise noise;
    noise.gyro_noise_deg = 0.015;
    noise.accel_noise = 2.5e-3;
    noise.gyro_bias_walk_deg = 1e-3;
    noise.accel_bias_walk = 5e-4;
    noise.accel_bias_sigma = 0.2;
    return noise;
  }
  static NdtOptions cells(double size)
  {
    NdtOptions options;
    options.cell_size = size;
    return options;
  }
  /** What is far away holds the angles, and few beams meet it. */
  static NdtOptions farCells(double size)
  {
    NdtOptions options = cells(size);
    options.min_points = 2;
    return options;
  }
  static NdtOptions thinned(NdtOptions options)
  {
    options.max_cells = 5000;
    return options;
  }
  static RegistrationOptions reach(double d2)
  {
    RegistrationOptions options;
    options.first_d2 = options.d2 = d2;
    options.min_overlap = 0.1;
    return options;
  }
};
}  // namespace scanloom
