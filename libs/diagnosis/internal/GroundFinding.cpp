#include "diagnosis/internal/GroundFinding.h"

#include "base/core/Angle.h"
#include "diagnosis/internal/FindingLimits.h"
#include "diagnosis/internal/ImuSoundness.h"
#include "estimation/imu/MeanForce.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
constexpr double kOverheadDeg = 145;  // slopes of 35 deg are ground
}

std::string groundInWords(const GroundPlane& ground)
{
  return fmt::format("{:.0f} % of the points within 12 m are on a plane {:.2f} m from the sensor, its normal ",
                     100 * ground.share, ground.sensor_height);
}

Finding groundFinding(const MountedLidar& lidar, const std::optional<GroundPlane>& ground)
{
  if (!ground) return {lidar.name, "ground", Verdict::NotMeasured, "no plane among the points within 12 m"};
  const double tilt = degreesBetween(ground->up, Eigen::Vector3d::UnitZ());
  Finding finding{lidar.name, "ground", grade(tilt, limits::kGroundTiltWarningDeg, limits::kGroundTiltNotFitDeg),
                  fmt::format("{}{:.1f} deg off the body's z; the body's origin {:.2f} m above it",
                              groundInWords(*ground), tilt, ground->body_height)};
  // Where the ground is hidden or too far, a ceiling looks like it, and on stairs a wall. An IMU knows better
  // (upFinding).
  const bool is_overhead = tilt > kOverheadDeg;
  if (is_overhead || ground->may_be_a_wall) finding.verdict = Verdict::Warning;
  if (finding.verdict == Verdict::NotFit)
    finding.says += fmt::format(": up is along {} of the body", nearestAxis(ground->up));
  if (const auto radians = mendOfRadians(lidar.body_T_sensor, ground->up))
  {
    finding.verdict = Verdict::NotFit;
    finding.mend = "of the lidar's pose " + *radians;
  }
  else if (finding.verdict != Verdict::Ok)
    finding.mend = fmt::format("the lidar's pose is wrong by {}{}", turnUpwards(ground->up),
                               is_overhead                           ? ", unless that plane is a ceiling"
                               : ground->may_be_a_wall               ? ", unless that plane is a wall"
                               : finding.verdict == Verdict::Warning ? ", or it stood before a slope"
                                                                     : "");
  return finding;
}
}  // namespace scanloom
