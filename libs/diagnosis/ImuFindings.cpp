#include "base/core/Angle.h"
#include "diagnosis/DoctorFindings.h"

#include <fmt/format.h>

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kStandardGravity = 9.80665;
constexpr Duration kMotionAveragesOut = 2s;

Finding timingFinding(const ImuExamination& imu, const ImuLimits& limits)
{
  const ImuTiming& t = imu.timing;
  Finding finding{imu.name, "rate", Verdict::Ok, fmt::format("{} samples", t.samples)};
  if (t.rate) finding.says += fmt::format(", {:.1f} Hz", *t.rate);
  finding.says += t.gaps == 0 ? ", no gaps"
                              : fmt::format(", {} gaps with {} samples lost, the longest {:.1f} ms", t.gaps, t.lost,
                                            1e3 * seconds(t.longest_gap));
  if (t.gaps > 0)
  {
    finding.verdict = seconds(t.longest_gap) > limits.imu_gap_not_fit ? Verdict::NotFit : Verdict::Warning;
    finding.mend = "read the IMU with priority over a link of its own; for a lidar's IMU see the lidar's loss";
  }
  if (t.backwards > 0)
  {
    finding.verdict = Verdict::NotFit;
    finding.says += fmt::format(", {} stamps that do not rise", t.backwards);
    finding.mend = "sort the samples by stamp, and look for a clock that was set while recording";
  }
  return finding;
}

Finding coverageFinding(const ImuExamination& imu)
{
  Finding finding{imu.name, "time", Verdict::Ok,
                  fmt::format("covers {:.1f} % of the lidars' time", 100 * *imu.lidar_share)};
  if (*imu.lidar_share > 0.9) return finding;
  finding.verdict = *imu.lidar_share > 0 ? Verdict::Warning : Verdict::NotFit;
  finding.mend = *imu.lidar_share > 0 ? "start the IMU before the lidars, and stop it after them"
                                      : "its stamps are of another clock: stamp both by PTP or by the same computer";
  return finding;
}

Finding gravityFinding(const ImuExamination& imu, const ImuLimits& limits)
{
  const double magnitude = imu.force_in_body.norm();
  Finding finding{imu.name, "gravity", Verdict::Ok, fmt::format("mean specific force {:.3f} m/s2", magnitude)};
  const ForceUnit unit = forceUnitOf(magnitude);
  if (unit != ForceUnit::MetresPerSecondSquared)
  {
    finding.verdict = Verdict::NotFit;
    finding.mend = adviceFor(unit);
    return finding;
  }
  if (std::abs(magnitude - kStandardGravity) <= limits.gravity_warning) return finding;
  finding.verdict = Verdict::NotMeasured;
  if (imu.timing.last - imu.timing.first < kMotionAveragesOut) return finding;
  finding.verdict = Verdict::Warning;
  finding.mend = "calibrate the accelerometer (six positions), or record a standstill to tell bias from motion";
  return finding;
}

Finding upFinding(const ImuExamination& imu, bool poses_known, const ImuLimits& limits)
{
  const Eigen::Vector3d up = imu.force_in_body.normalized();
  const double tilt = degreesBetween(up, Eigen::Vector3d::UnitZ());
  Finding finding{imu.name, "up", Verdict::Ok, ""};
  if (!poses_known)
  {
    finding.verdict = Verdict::NotMeasured;
    finding.says =
        fmt::format("{:.1f} deg off +z of the sensor frame, nearest axis {} (its pose on the body is not known)", tilt,
                    nearestAxis(up));
    return finding;
  }
  finding.says = fmt::format("{:.1f} deg off the body's z", tilt);
  if (tilt <= limits.tilt_warning_deg) return finding;
  finding.verdict = tilt > limits.tilt_not_fit_deg ? Verdict::NotFit : Verdict::Warning;
  if (finding.verdict == Verdict::NotFit) finding.says += fmt::format(": up is along {} of the body", nearestAxis(up));
  finding.mend = tilt > 170
                     ? "the accelerometer measures gravity instead of specific force (change all signs), or its "
                       "pose is wrong by 180 deg about x or y"
                     : fmt::format("the IMU's (or its lidar's) pose is wrong by {}{}", turnUpwards(up),
                                   finding.verdict == Verdict::Warning ? ", or the machine stood on a slope" : "");
  return finding;
}

bool isAbout(double value, double expected) { return std::abs(value / expected - 1) < 0.5; }

Finding gyroFinding(const ImuExamination& imu, const ImuLimits& limits)
{
  constexpr double kImpossibleTilt = 0.1;  // rad/s: the machine would lie on its side after 16 s
  Finding finding{imu.name, "gyro units", Verdict::NotMeasured, "not enough rotation to tell"};
  if (!imu.gyro_scale) return finding;
  const GyroScale& g = *imu.gyro_scale;
  if (g.tilt_rate > kImpossibleTilt || (isAbout(g.scale, kDegree) && g.sigma < 0.2 * kDegree))
  {
    finding.verdict = Verdict::NotFit;
    finding.says =
        fmt::format("true rates are {:.4f} times the measured ones; the mean rate tilts the machine by {:.2f} rad/s",
                    g.scale, g.tilt_rate);
    finding.mend = "the values are in deg/s: multiply them by 0.0174533";
    return finding;
  }
  if (g.sigma > 0.5 * std::abs(g.scale) && g.sigma > 0.1) return finding;
  finding.verdict = Verdict::Ok;
  finding.says = fmt::format("rad/s: gravity turns {:.2f} times as much as measured (standard deviation {:.2f})",
                             g.scale, g.sigma);
  const bool low = g.scale + 3 * g.sigma < 1 / limits.gyro_scale_factor;
  const bool high = g.scale - 3 * g.sigma > limits.gyro_scale_factor;
  if (!low && !high) return finding;
  finding.verdict = Verdict::NotFit;
  finding.says =
      fmt::format("gravity turns {:.2f} times as much as measured (standard deviation {:.2f})", g.scale, g.sigma);
  finding.mend = g.scale < 0 ? "change the signs of the gyroscope: its rotations are left-handed"
                 : isAbout(g.scale, 1 / kDegree)
                     ? "the values were converted from deg/s twice: multiply them by 57.2958"
                     : "check the gyroscope's unit, full-scale setting and axes against the accelerometer's";
  return finding;
}
}  // namespace

Findings imuFindings(const RigExamination& rig, std::size_t index, const ImuLimits& limits)
{
  const ImuExamination& imu = rig.imus[index];
  Findings findings{timingFinding(imu, limits)};
  if (imu.lidar_share) findings.push_back(coverageFinding(imu));
  findings.push_back(gravityFinding(imu, limits));
  findings.push_back(upFinding(imu, rig.poses_known, limits));
  findings.push_back(gyroFinding(imu, limits));
  if (imu.compared)
    findings.push_back(turnsFinding(*imu.compared, imu.name, rig.imus[imu.compared->reference].name, limits));
  return findings;
}
}  // namespace scanloom
