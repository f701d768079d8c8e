#include "diagnosis/internal/PoseFinding.h"

#include "base/core/Angle.h"
#include "diagnosis/internal/FindingLimits.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr double kLargestOffset = 1, kLargestTurn = 15;  // m, deg: what registration with cells of 2 m can correct
constexpr double kDeviations = 4;                        // by 200 good drives of 5 to 20 s, some with three turns
constexpr double kLeastSigma = 0.02;                     // of near_share: the scatter of a few turns tells little
// Sound rigs have 1.02 at most, those that are 1 deg or 0.1 m off at least 1.03, but for 0.1 m ahead on a bare field.
constexpr double kLeastGain = 1.03;
constexpr std::size_t kFewestPlaces = 3;  // one may have a pose that the drive's beginning left wrong
constexpr const char* kMeasureAgain =
    "measure both poses again: x y z in m, yaw pitch roll in deg, of the sensor frame in the body; see that each lidar "
    "has its own metadata file, or let 'scanloom calibrate' find the pose from a drive";
}  // namespace

Finding poseFinding(const std::string& lidar, const std::string& other, const std::optional<CloudAgreement>& agreement)
{
  Finding finding{lidar, "pose", Verdict::NotMeasured, fmt::format("too few points that '{}' sees as well", other)};
  if (!agreement) return finding;
  const CloudAgreement& a = *agreement;
  finding.says = fmt::format("{:.0f} % (+-{:.0f}) of {} common points agree with '{}'", 100 * a.near_share,
                             100 * a.near_sigma, a.common, other);
  const double at_best = a.near_share + kDeviations * std::max(a.near_sigma, kLeastSigma);
  finding.verdict = at_best < limits::kNearShareWarning        ? Verdict::NotFit
                    : a.near_share < limits::kNearShareWarning ? Verdict::Warning
                                                               : Verdict::Ok;
  if (finding.verdict != Verdict::Ok) finding.mend = kMeasureAgain;
  if (!a.correction)
  {
    finding.says += a.turns < 3 ? "; too few turns for a registration" : "; registration found no better pose";
    return finding;
  }
  const CloudAgreement::Correction& c = *a.correction;
  const Eigen::Vector3d degrees = c.rotation / kDegree;
  finding.says += fmt::format("; best fit of {} turns {:.3f} m (+-{:.3f}) and {:.2f} deg (+-{:.2f}) off", a.turns,
                              c.offset.norm(), c.offset_sigma, degrees.norm(), c.rotation_sigma / kDegree);
  const auto atLeast = [](double value, double sigma) { return value - kDeviations * sigma; };
  const Verdict fit =
      std::max(grade(atLeast(c.offset.norm(), c.offset_sigma), limits::kPoseOffsetWarning, limits::kPoseOffsetNotFit),
               grade(atLeast(degrees.norm(), c.rotation_sigma / kDegree), limits::kPoseAngleWarningDeg,
                     limits::kPoseAngleNotFitDeg));
  if (fit == Verdict::Ok || c.score_gain < kLeastGain) return finding;
  finding.verdict = std::max(finding.verdict, fit);
  if (c.offset.norm() > kLargestOffset || degrees.norm() > kLargestTurn)
    finding.mend = fmt::format(
        "{}; registration cannot measure so large an error: compare 'turns' and 'up' of the IMUs", kMeasureAgain);
  else
    finding.mend = fmt::format(
        "if '{}' is right, move the sensor by ({:.2f} {:.2f} {:.2f}) m and turn it by ({:.1f} {:.1f} {:.1f}) deg about "
        "the body's x y z: then {:.0f} % agree; 'scanloom calibrate' finds it to millimetres from a drive",
        other, c.offset.x(), c.offset.y(), c.offset.z(), degrees.x(), degrees.y(), degrees.z(), 100 * c.near_share);
  return finding;
}

Finding steadinessFinding(const std::string& lidar, const std::optional<OverlapOverTurns>& on_the_way)
{
  Finding finding{lidar, "steadiness", Verdict::NotMeasured, "too few points that are seen again on the way"};
  if (!on_the_way || on_the_way->turns.size() < kFewestPlaces) return finding;
  finding.says = fmt::format("{:.0f} % (+-{:.0f}) of {} points that are seen again on the way are in the same place",
                             100 * on_the_way->near_share, 100 * on_the_way->near_sigma, on_the_way->common);
  const bool is_low = on_the_way->near_share + 2 * on_the_way->near_sigma < limits::kNearShareWarning;
  finding.verdict = is_low ? Verdict::Warning : Verdict::Ok;
  if (finding.verdict != Verdict::Ok)
    finding.mend =
        "its pose in the body is wrong, or its metadata file is another lidar's: measure x y z in m, yaw pitch roll in "
        "deg, of the sensor frame in the body";
  return finding;
}
}  // namespace scanloom
