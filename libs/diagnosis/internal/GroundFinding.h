/** Whether the ground that a lidar sees is below the body; `scanloom doctor` and `scanloom slam` say it alike. */
#pragma once
#include "base/core/Field.h"
#include "base/core/Finding.h"
#include "base/core/MountedLidar.h"
#include "calibration/GroundPlane.h"

#include <optional>
#include <string>

namespace scanloom
{
struct GeometryLimits
{
  double ground_tilt_warning_deg = 15;
  double ground_tilt_not_fit_deg = 45;
  double ground_angle_warning_deg = 3;
  double ground_height_warning = 0.15;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.ground_tilt_warning_deg,
          Field{"ground_tilt_warning_deg", "deg",
                "angle of the ground plane's normal to the body's z; forest roads are less steep", above(0)});
    visit(o.ground_tilt_not_fit_deg,
          Field{"ground_tilt_not_fit_deg", "deg",
                "angle of the ground plane's normal to the body's z; the pose has a wrong axis", above(0)});
    visit(o.ground_angle_warning_deg,
          Field{"ground_angle_warning_deg", "deg", "angle between two lidars' ground planes; roll or pitch is wrong",
                above(0)});
    visit(o.ground_height_warning,
          Field{"ground_height_warning", "m", "height between two lidars' ground planes; z is wrong", above(0)});
  }
};

/** "27 % of the points within 12 m are on a plane 2.51 m from the sensor, its normal ": its angle follows. */
std::string groundInWords(const GroundPlane&);

/** About a lidar whose pose in the body is known. */
Finding groundFinding(const MountedLidar&, const std::optional<GroundPlane>&, const GeometryLimits&);
}  // namespace scanloom
