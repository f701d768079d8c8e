#include <fmt/format.h>

#include <cmath>

#include "doctor/DoctorFindings.h"

namespace scanloom
{
namespace
{
constexpr double kDegree = M_PI / 180;
constexpr double kFarthest = 1, kLargestTurn = 15;  // m, deg: what registration with cells of 2 m can correct
constexpr const char* kMeasureAgain =
    "measure both poses again: x y z in m, yaw pitch roll in deg, of the sensor frame in the body";

Finding groundFinding(const LidarExamination& seen, bool poses_known, const GeometryLimits& limits)
{
  Finding finding{seen.name, "ground", Verdict::NotMeasured, "no plane among the points within 12 m"};
  if (!seen.ground) return finding;
  const GroundPlane& ground = *seen.ground;
  const double tilt = degreesBetween(ground.up, Eigen::Vector3d::UnitZ());
  finding.says = fmt::format("{:.0f} % of the points within 12 m are on a plane {:.2f} m from the sensor, its normal ",
                             100 * ground.share, ground.sensor_height);
  if (!poses_known)
  {
    finding.says += fmt::format("{:.1f} deg off +z of the sensor frame (poses are known only with -c CONFIG)", tilt);
    return finding;
  }
  finding.says +=
      fmt::format("{:.1f} deg off the body's z; the body's origin {:.2f} m above it", tilt, ground.body_height);
  finding.verdict = grade(tilt, limits.ground_tilt_warning_deg, limits.ground_tilt_not_fit_deg);
  if (finding.verdict == Verdict::NotFit)
    finding.says += fmt::format(": up is along {} of the body", nearestAxis(ground.up));
  if (finding.verdict != Verdict::Ok)
    finding.mend = fmt::format("the lidar's pose is wrong by {}{}", turnUpwards(ground.up),
                               finding.verdict == Verdict::Warning ? ", or it stood before a slope" : "");
  return finding;
}

Finding ownPartsFinding(const LidarExamination& seen)
{
  const OwnParts& parts = seen.own_parts;
  if (!parts.known) return {seen.name, "own parts", Verdict::NotMeasured, "only seen while the machine drives"};
  Finding finding{seen.name, "own parts", Verdict::Ok,
                  fmt::format("{:.1f} % of the points are on the machine itself", 100 * parts.share)};
  if (!parts.box.isEmpty())
    finding.says += fmt::format(", within x {:.1f} to {:.1f}, y {:.1f} to {:.1f}, z {:.1f} to {:.1f} m",
                                parts.box.min().x(), parts.box.max().x(), parts.box.min().y(), parts.box.max().y(),
                                parts.box.min().z(), parts.box.max().z());
  return finding;
}

Finding groundsFinding(const LidarExamination& seen, const LidarExamination& first, const GeometryLimits& limits)
{
  const double angle = degreesBetween(seen.ground->up, first.ground->up);
  const double height = seen.ground->body_height - first.ground->body_height;
  Finding finding{seen.name, "common ground", Verdict::Ok,
                  fmt::format("{:.1f} deg and {:+.3f} m off the ground that '{}' sees", angle, -height, first.name)};
  if (angle > limits.ground_angle_warning_deg || std::abs(height) > limits.ground_height_warning)
  {
    finding.verdict = Verdict::Warning;
    finding.mend = "roll, pitch or z of one of the two poses is wrong; see pose";
  }
  return finding;
}
}  // namespace

Findings groundFindings(const RigExamination& rig, std::size_t lidar, const GeometryLimits& limits)
{
  const LidarExamination &seen = rig.lidars[lidar], &first = rig.lidars.front();
  Findings findings;
  if (const auto& returns = seen.returns)
    findings.push_back({seen.name, "returns", Verdict::Ok,
                        fmt::format("{:.1f} % of the shots; 5, 50, 95 % of the returns within {:.1f}, {:.1f}, {:.1f} m",
                                    100 * returns->share, returns->range_p05, returns->range_p50, returns->range_p95)});
  findings.push_back(groundFinding(seen, rig.poses_known, limits));
  findings.push_back(ownPartsFinding(seen));
  if (lidar > 0 && rig.poses_known && seen.ground && first.ground)
    findings.push_back(groundsFinding(seen, first, limits));
  return findings;
}

Finding poseFinding(const RigExamination& rig, const PairExamination& pair, const GeometryLimits& limits)
{
  const std::string& other = rig.lidars[pair.reference].name;
  Finding finding{rig.lidars[pair.lidar].name, "pose", Verdict::NotMeasured,
                  fmt::format("too few points that '{}' sees as well", other)};
  if (!pair.agreement) return finding;
  const CloudAgreement& a = *pair.agreement;
  finding.says = fmt::format("{:.0f} % of {} common points agree with '{}'", 100 * a.near_share, a.common, other);
  finding.verdict = a.near_share < limits.near_share_warning ? Verdict::Warning : Verdict::Ok;
  if (finding.verdict != Verdict::Ok) finding.mend = kMeasureAgain;
  if (!a.correction)
  {
    finding.says += "; registration found no better pose";
    return finding;
  }
  const CloudAgreement::Correction& c = *a.correction;
  const Eigen::Vector3d degrees = c.rotation / kDegree;
  finding.says += fmt::format("; best fit of {} turns {:.3f} m (+-{:.3f}) and {:.2f} deg (+-{:.2f}) off", a.turns,
                              c.offset.norm(), c.offset_sigma, degrees.norm(), c.rotation_sigma / kDegree);
  const Verdict fit =
      std::max(grade(c.offset.norm() - 3 * c.offset_sigma, limits.pose_offset_warning, limits.pose_offset_not_fit),
               grade(degrees.norm() - 3 * c.rotation_sigma / kDegree, limits.pose_angle_warning_deg,
                     limits.pose_angle_not_fit_deg));
  if (fit == Verdict::Ok) return finding;
  finding.verdict = std::max(finding.verdict, fit);
  if (c.offset.norm() > kFarthest || degrees.norm() > kLargestTurn)
    finding.mend = fmt::format(
        "{}; registration cannot measure so large an error: compare 'turns' and 'up' of the IMUs", kMeasureAgain);
  else
    finding.mend = fmt::format(
        "if '{}' is right, move the sensor by ({:.2f} {:.2f} {:.2f}) m and turn it by ({:.1f} {:.1f} {:.1f}) deg about "
        "the body's x y z: then {:.0f} % agree",
        other, c.offset.x(), c.offset.y(), c.offset.z(), degrees.x(), degrees.y(), degrees.z(), 100 * c.near_share);
  return finding;
}
}  // namespace scanloom
