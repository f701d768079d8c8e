#include "base/core/Angle.h"
#include "diagnosis/DoctorFindings.h"
#include "diagnosis/internal/FindingLimits.h"
#include "diagnosis/internal/GroundFinding.h"

#include <fmt/format.h>

#include <cmath>

namespace scanloom
{
namespace
{
Finding groundInSensorFrame(const std::string& lidar, const GroundPlane& ground)
{
  return {lidar, "ground", Verdict::NotMeasured,
          fmt::format("{}{:.1f} deg off +z of the sensor frame (its pose on the body is not known)",
                      groundInWords(ground), degreesBetween(ground.up, Eigen::Vector3d::UnitZ()))};
}

Finding ownPartsFinding(const LidarExamination& seen)
{
  if (!seen.own_parts.known)
    return {seen.name, "own parts", Verdict::NotMeasured, "only seen while the machine drives"};
  return {seen.name, "own parts", Verdict::Ok,
          fmt::format("{:.1f} % of the points stay in place while the machine drives, as its parts do",
                      100 * seen.own_parts.share)};
}

Finding groundsFinding(const LidarExamination& seen, const LidarExamination& first)
{
  const double angle = degreesBetween(seen.ground->up, first.ground->up);
  const double height = seen.ground->body_height - first.ground->body_height;
  Finding finding{seen.name, "common ground", Verdict::Ok,
                  fmt::format("{:.1f} deg and {:+.3f} m off the ground that '{}' sees", angle, -height, first.name)};
  if (angle > limits::kGroundAngleWarningDeg || std::abs(height) > limits::kGroundHeightWarning)
  {
    finding.verdict = Verdict::Warning;
    finding.mend = "roll, pitch or z of one of the two poses is wrong; see pose";
  }
  return finding;
}
}  // namespace

Findings groundFindings(const RigExamination& rig, std::size_t lidar)
{
  const LidarExamination &seen = rig.lidars[lidar], &first = rig.lidars.front();
  Findings findings;
  if (const auto& returns = seen.returns)
    findings.push_back({seen.name, "returns", Verdict::Ok,
                        fmt::format("{:.1f} % of the shots; 5, 50, 95 % of the returns within {:.1f}, {:.1f}, {:.1f} m",
                                    100 * returns->share, returns->range_p05, returns->range_p50, returns->range_p95)});
  findings.push_back(rig.poses_known || !seen.ground ? groundFinding({seen.name, seen.lidar.body_T_sensor}, seen.ground)
                                                     : groundInSensorFrame(seen.name, *seen.ground));
  findings.push_back(ownPartsFinding(seen));
  if (lidar > 0 && rig.poses_known && seen.ground && first.ground) findings.push_back(groundsFinding(seen, first));
  return findings;
}
}  // namespace scanloom
