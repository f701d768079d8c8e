/** Whether the poses of two lidars on the body fit what both see; `scanloom doctor` and `scanloom slam` say it alike.
 */
#pragma once
#include "base/core/Field.h"
#include "base/core/Finding.h"
#include "calibration/CloudAgreement.h"

#include <optional>
#include <string>

namespace scanloom
{
struct PoseLimits
{
  double near_share_warning = 0.5;
  double pose_offset_warning = 0.05;
  double pose_offset_not_fit = 0.25;
  double pose_angle_warning_deg = 0.3;
  double pose_angle_not_fit_deg = 3;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.near_share_warning,
          Field{"near_share_warning", "", "share of the points that another lidar should see and sees within 0.3 m",
                between(0, 1)});
    visit(o.pose_offset_warning,
          Field{"pose_offset_warning", "m", "error by registration to the first lidar; drift grows by half", above(0)});
    visit(o.pose_offset_not_fit,
          Field{"pose_offset_not_fit", "m",
                "error by registration to the first lidar; more than the width of most stems", above(0)});
    visit(o.pose_angle_warning_deg,
          Field{"pose_angle_warning_deg", "deg", "error by registration to the first lidar; drift doubles", above(0)});
    visit(o.pose_angle_not_fit_deg, Field{"pose_angle_not_fit_deg", "deg",
                                          "error by registration to the first lidar; half a metre at 10 m", above(0)});
  }
};

/**
 * About `lidar`, if the pose of `other` is right. Four standard deviations are subtracted from an error before it is
 * compared with the limits, and it counts only if more agrees without it.
 */
Finding poseFinding(const std::string& lidar, const std::string& other, const std::optional<CloudAgreement>&,
                    const PoseLimits&);

/**
 * About a lidar alone: whether what it sees stays in place while the machine drives. A lidar that is mounted the other
 * way round turns against the body, and one with another's beam angles bends the ground.
 */
Finding steadinessFinding(const std::string& lidar, const std::optional<OverlapOverTurns>& on_the_way,
                          const PoseLimits&);
}  // namespace scanloom
