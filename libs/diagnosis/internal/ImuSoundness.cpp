#include "diagnosis/internal/ImuSoundness.h"

#include "base/core/Angle.h"
#include "diagnosis/internal/FindingLimits.h"
#include "estimation/imu/MeanForce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kStandardGravity = 9.80665;
constexpr Duration kMotionAveragesOut = 2s;
constexpr Duration kSustained = 5s;
constexpr double kAnotherUnit = 4;  // factor: accelerations of a drive falsify a scale by gravity by less, a unit by 57

/** Length of the largest mean rate over kSustained: of a true rate it is that of a corner. */
double sustainedRate(const std::vector<ImuSample>& samples)
{
  double largest = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t first = 0, i = 0; i < samples.size(); ++i)
  {
    sum += samples[i].gyro;
    if (samples[i].stamp - samples[first].stamp < kSustained) continue;
    largest = std::max(largest, sum.norm() / static_cast<double>(i - first + 1));
    for (; samples[i].stamp - samples[first].stamp >= kSustained; ++first) sum -= samples[first].gyro;
  }
  return largest;
}
}  // namespace

ImuSoundness soundnessOf(const std::vector<ImuSample>& samples, const Rigid& body_T_imu)
{
  ImuSoundness sound;
  if (samples.empty()) return sound;
  sound.span = samples.back().stamp - samples.front().stamp;
  sound.force_in_body = body_T_imu.rotation * *meanForce(samples);
  sound.gyro_scale = gyroScale(samples);
  sound.sustained_rate = sustainedRate(samples);
  return sound;
}

std::optional<std::string> mendOfTurnRates(double ratio, double factor)
{
  const auto isAbout = [&](double unit) { return ratio > unit / factor && ratio < unit * factor; };
  if (isAbout(1 / kDegree)) return "they are in deg/s, multiply them by 0.0174533";
  if (isAbout(kDegree)) return "they were converted from deg/s twice, multiply them by 57.2958";
  if (ratio < 0) return "they are left-handed, change their signs";
  return std::nullopt;
}

std::optional<std::string> mendOfRadians(const Rigid& configured, const Eigen::Vector3d& up_in_body)
{
  constexpr double kTilted = 12, kLargest = 2 * M_PI, kLeast = 0.05;  // deg; the angles that radians can be
  const Eigen::Matrix3d as_degrees = configured.rotation.toRotationMatrix();
  const Eigen::Vector3d angles = configured.yawPitchRoll() / kDegree;
  const double largest = angles.cwiseAbs().maxCoeff();
  if (largest > kLargest || largest < kLeast) return std::nullopt;
  const Rigid as_radians = Rigid::fromXyzYawPitchRoll(0, 0, 0, angles[0], angles[1], angles[2]);
  const double tilt = degreesBetween(up_in_body, Eigen::Vector3d::UnitZ());
  const double other =
      degreesBetween(as_radians.rotation * (as_degrees.transpose() * up_in_body), Eigen::Vector3d::UnitZ());
  if (tilt < kTilted || other > tilt / 2 || other > kTilted) return std::nullopt;
  return fmt::format(
      "yaw pitch roll = {:.3f} {:.3f} {:.3f} seem to be radians, which would leave {:.1f} deg: give {:.1f} {:.1f} "
      "{:.1f} deg",
      angles[0], angles[1], angles[2], other, angles[0] / kDegree, angles[1] / kDegree, angles[2] / kDegree);
}

Finding gravityFinding(const std::string& imu, const ImuSoundness& sound)
{
  const double magnitude = sound.force_in_body.norm();
  Finding finding{imu, "gravity", Verdict::Ok, fmt::format("mean specific force {:.3f} m/s2", magnitude)};
  const ForceUnit unit = forceUnitOf(magnitude);
  if (unit != ForceUnit::MetresPerSecondSquared)
  {
    finding.verdict = Verdict::NotFit;
    finding.mend = adviceFor(unit);
    return finding;
  }
  if (std::abs(magnitude - kStandardGravity) <= limits::kGravityWarning) return finding;
  finding.verdict = Verdict::NotMeasured;
  if (sound.span < kMotionAveragesOut) return finding;
  finding.verdict = Verdict::Warning;
  finding.mend = "calibrate the accelerometer (six positions), or record a standstill to tell bias from motion";
  return finding;
}

Finding upFinding(const std::string& imu, const ImuSoundness& sound, const Rigid& configured)
{
  const Eigen::Vector3d up = sound.force_in_body.normalized();
  const double tilt = degreesBetween(up, Eigen::Vector3d::UnitZ());
  Finding finding{imu, "up", grade(tilt, limits::kTiltWarningDeg, limits::kTiltNotFitDeg),
                  fmt::format("{:.1f} deg off the body's z", tilt)};
  if (finding.verdict == Verdict::NotFit) finding.says += fmt::format(": up is along {} of the body", nearestAxis(up));
  if (const auto radians = mendOfRadians(configured, up))
  {
    finding.verdict = Verdict::NotFit;
    finding.mend = "of the IMU's (or its lidar's) pose " + *radians;
  }
  else if (finding.verdict != Verdict::Ok)
    finding.mend = tilt > 170
                       ? "the accelerometer measures gravity instead of specific force (change all signs), or its "
                         "pose is wrong by 180 deg about x or y"
                       : fmt::format("the IMU's (or its lidar's) pose is wrong by {}{}", turnUpwards(up),
                                     finding.verdict == Verdict::Warning ? ", or the machine stood on a slope" : "");
  return finding;
}

Finding gyroFinding(const std::string& imu, const ImuSoundness& sound)
{
  constexpr double kImpossibleTilt = 0.1;   // rad/s: the machine would lie on its side after 16 s
  constexpr double kImpossibleRate = M_PI;  // rad/s: half a turn a second for 5 s
  constexpr double kSure = 0.2;             // standard deviation over scale
  constexpr double kVague = 0.5;  // the same; and standard deviation: on the level floor of a car park it is 1.1
  // Of 0.5 in forests; on a street at 8 m/s it is 0.13, and the shaking falsifies the scale by a factor of 5.
  constexpr double kExplained = 0.3;
  Finding finding{imu, "gyro units", Verdict::NotMeasured, "not enough rotation to tell"};
  if (sound.sustained_rate > kImpossibleRate)
  {
    finding.verdict = Verdict::NotFit;
    finding.says = fmt::format("turn rates of {:.1f} rad/s for 5 s, as of no machine", sound.sustained_rate);
    finding.mend = *mendOfTurnRates(1 / kDegree, kAnotherUnit);
    return finding;
  }
  if (!sound.gyro_scale) return finding;
  const GyroScale& g = *sound.gyro_scale;
  const double share = g.sigma / std::abs(g.scale);
  const auto unit = share < kSure ? mendOfTurnRates(1 / g.scale, kAnotherUnit) : std::nullopt;
  const bool tips_over = g.tilt_rate > kImpossibleTilt;
  const bool low = g.sigma < kVague && g.scale + 3 * g.sigma < 1 / limits::kGyroScaleFactor;
  const bool high = share < kSure && g.explained > kExplained && g.scale - 3 * g.sigma > limits::kGyroScaleFactor;
  const bool is_wrong = unit || tips_over || low || high;
  if (!is_wrong && (g.sigma > kVague || (share > kVague && g.sigma > 0.1))) return finding;
  finding.verdict = Verdict::Ok;
  finding.says = fmt::format("rad/s: gravity turns {:.2f} times as much as measured (standard deviation {:.2f})",
                             g.scale, g.sigma);
  if (!is_wrong) return finding;
  finding.verdict = Verdict::NotFit;
  finding.says =
      fmt::format("gravity turns {:.4f} times as much as measured (standard deviation {:.4f})", g.scale, g.sigma);
  if (tips_over) finding.says += fmt::format("; the mean rate tilts the machine by {:.2f} rad/s", g.tilt_rate);
  if (!unit && !tips_over && g.scale >= 0)
    finding.mend = "check the gyroscope's unit, full-scale setting and axes against the accelerometer's";
  else
    finding.mend = unit.value_or(*mendOfTurnRates(tips_over ? 1 / kDegree : -1, kAnotherUnit));
  return finding;
}
}  // namespace scanloom
