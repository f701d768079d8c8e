/** Everything that localisation depends on: sections of the INI file, and what only code and tests change. */
#pragma once
#include "base/config/Schema.h"
#include "estimation/graph/FixedLagSmoother.h"
#include "estimation/imu/ImuInitialisation.h"
#include "estimation/imu/Preintegration.h"
#include "estimation/preprocessing/Crop.h"
#include "estimation/slam/internal/Assessment.h"
#include "estimation/slam/internal/LocalMap.h"
#include "estimation/slam/internal/ScanRegistration.h"

#include <string>

namespace scanloom
{
/** [slam]: which scans and which IMU are used, and how. */
struct SlamOptions
{
  int every_nth = 1;
  std::string imu = "auto";
  double imu_delay_ms = 0;
  double imu_wait_ms = 50;  // ms: how long a scan waits for IMU samples up to its end
  bool forest = true;
  bool relative = true;
  TrustOptions trust;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.every_nth, Field{"every_nth", "", "use every N-th scan only; IMU samples are all used", atLeast(1)});
    visit(o.imu,
          Field{"imu", "",
                "body, the name of a lidar (its own IMU), none (constant velocity and turn rate are assumed), or "
                "auto: the body's if there is one, else the first lidar's, another one where that shakes ten times as "
                "much or falls silent, and none where no IMU sends in the first second"});
    visit(o.imu_delay_ms, Field{"imu_delay_ms", "ms",
                                "how much later the IMU's stamps are than the lidars' for the same instant; slam "
                                "reports an estimate at its end",
                                between(-500, 500)});
    visit(o.forest,
          Field{"forest", "",
                "register stems by their axes and foliage by its middle, not by the side that the lidars see; false in "
                "streets and halls"});
    visit(o.relative, Field{"relative", "",
                            "true: a registration is a pose relative to the first keyframe, whose attitude may still "
                            "be corrected by gravity; false, and without an IMU: a pose in the map, as in the paper"});
  }
};

struct SlamSettings
{
  SlamOptions slam;
  StandstillOptions start;
  ImuNoise imu;
  ImuNoise lidar_imu = insideLidar();
  ImuNoise no_imu = ofConstantMotion();
  CropOptions crop;
  ScanRegistrationOptions registration{cells(2.5), thinned(farCells(1.0)), reach(0.3), reach(1.0)};
  NdtOptions map_cells = farCells(1.0);
  NdtOptions keyframe_cells = thinned(farCells(0.75));
  LocalMapOptions local_map;
  SmootherOptions smoother;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.slam, Section{"slam", "lidar-inertial localisation"});
    visit(s.start, Section{"start", "the first attitude and gyro bias, from standstill"});
    visit(s.imu, Section{"imu_noise", "noise of the body's IMU"});
    visit(s.crop, Section{"crop", CropOptions::kMeaning});
    visit(s.registration.scan_cells, Section{"scan_cells", "NDT cells of a scan for the rough alignment"});
    visit(s.registration.fine_cells, Section{"fine_cells", "NDT cells of a scan for the fine alignment"});
    visit(s.map_cells, Section{"map_cells", "NDT cells of the local map"});
    visit(s.keyframe_cells, Section{"keyframe_cells", "NDT cells of a scan that becomes a keyframe"});
    visit(s.local_map, Section{"local_map", "the keyframes that a scan is aligned to"});
  }

 private:
  /**
   * Noise of a consumer's chip, as Ouster's are assumed to be; but the walk of the accelerometer's bias is 40 times the
   * 5e-4 assumed of them. At a start at rest a bias looks like a tilt, up to 2 deg of it, and a bias that hardly walks
   * keeps that for the whole run. Fitted on both generators: doc/study/localisation.md#beyond-the-forest.
   */
  static ImuNoise insideLidar()
  {
    ImuNoise noise;
    noise.gyro_noise_deg = 0.015;
    noise.accel_noise = 2.5e-3;
    noise.gyro_bias_walk_deg = 1e-3;
    noise.accel_bias_walk = 2e-2;
    noise.accel_bias_sigma = 0.2;
    return noise;
  }
  /** Motion of a machine that sways: it turns with up to 8 deg/s and accelerates with 1 m/s2 (assumed to be white
   * noise). */
  static ImuNoise ofConstantMotion()
  {
    ImuNoise noise;
    noise.gyro_noise_deg = 3;
    noise.accel_noise = 0.5;
    return noise;
  }
  static NdtOptions cells(double size)
  {
    NdtOptions options;
    options.cell_size = size;
    return options;
  }
  /** Far cells hold few points, but they determine the angles. */
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
