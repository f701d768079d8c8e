#include "calibration/GroundFinding.h"

#include "base/core/Angle.h"
#include "estimation/imu/MeanForce.h"

#include <fmt/format.h>

namespace scanloom
{
std::string groundInWords(const GroundPlane& ground)
{
  return fmt::format("{:.0f} % of the points within 12 m are on a plane {:.2f} m from the sensor, its normal ",
                     100 * ground.share, ground.sensor_height);
}

Finding groundFinding(const std::string& lidar, const std::optional<GroundPlane>& ground, const GeometryLimits& limits)
{
  if (!ground) return {lidar, "ground", Verdict::NotMeasured, "no plane among the points within 12 m"};
  const double tilt = degreesBetween(ground->up, Eigen::Vector3d::UnitZ());
  Finding finding{lidar, "ground", grade(tilt, limits.ground_tilt_warning_deg, limits.ground_tilt_not_fit_deg),
                  fmt::format("{}{:.1f} deg off the body's z; the body's origin {:.2f} m above it",
                              groundInWords(*ground), tilt, ground->body_height)};
  if (finding.verdict == Verdict::NotFit)
    finding.says += fmt::format(": up is along {} of the body", nearestAxis(ground->up));
  if (finding.verdict != Verdict::Ok)
    finding.mend = fmt::format("the lidar's pose is wrong by {}{}", turnUpwards(ground->up),
                               finding.verdict == Verdict::Warning ? ", or it stood before a slope" : "");
  return finding;
}
}  // namespace scanloom
