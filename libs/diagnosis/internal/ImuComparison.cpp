#include "diagnosis/internal/ImuComparison.h"

#include "base/core/Angle.h"
#include "diagnosis/internal/ImuSoundness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kSigmas = 4;  // certain
constexpr double kUnit = 1.1;  // factor: two gyroscopes tell a unit from a wrong scale

bool isScaled(const GyroAgreement& a, const TurnLimits& limits)
{
  const double error = std::abs(a.scale - 1);
  return error > limits.scale && error > kSigmas * a.scale_sigma;
}

bool isTurned(const GyroAgreement& a, const TurnLimits& limits)
{
  const double angle = a.rotation.norm();
  return angle > limits.angle_deg * kDegree && angle > kSigmas * a.sigma;
}

bool isLate(const GyroAgreement& a, const TurnLimits& limits)
{
  const double lag = std::abs(seconds(a.lag));
  return lag > 1e-3 * limits.lag_ms && lag > kSigmas * a.lag_sigma;
}

bool agrees(const GyroAgreement& a, const TurnLimits& limits)
{
  return !a.mirrored && !isScaled(a, limits) && !isTurned(a, limits) && !isLate(a, limits);
}

/** `reversed`: by its direction one axis is, or two are exchanged; in the IMU's frame. */
std::string faultOfHands(const Eigen::Vector3d& reversed)
{
  constexpr double kAlong = 0.94;  // cosine of 20 deg
  Eigen::Index largest = 0;
  if (reversed.normalized().cwiseAbs().maxCoeff(&largest) < kAlong) return "two of them are exchanged";
  return fmt::format("the sign of its turn rate about {} is wrong", "xyz"[largest]);
}

/** What is wrong, and how it is mended; the verdict of `finding` is graded. */
Finding withFault(Finding finding, const ImuComparison& compared, const std::string& reference,
                  const TurnLimits& limits)
{
  const GyroAgreement& a = *compared.agreement;
  const std::string or_of_other = compared.outvoted ? "" : fmt::format(", or of {},", reference);
  finding.verdict = Verdict::Warning;
  if (a.mirrored)
  {
    finding.verdict = Verdict::NotFit;
    finding.mend = fmt::format("its axes{} are left-handed: {}", or_of_other,
                               faultOfHands(compared.body_R_imu.conjugate() * a.rotation));
  }
  else if (isTurned(a, limits))
  {
    if (a.rotation.norm() - kSigmas * a.sigma > limits.angle_deg * kDegree) finding.verdict = Verdict::NotFit;
    const Eigen::Vector3d axis = a.rotation.normalized();
    finding.mend = fmt::format(
        "its pose in the body (or its lidar's){} is wrong: turn it by {:.1f} deg about ({:.2f} "
        "{:.2f} {:.2f})",
        or_of_other, a.rotation.norm() / kDegree, axis.x(), axis.y(), axis.z());
  }
  else if (isScaled(a, limits))
    finding.mend = fmt::format("the unit or scale of its turn rates{} is wrong: {}", or_of_other,
                               mendOfTurnRates(a.scale, kUnit).value_or(fmt::format("divide them by {:.3f}", a.scale)));
  else
    finding.mend = fmt::format("stamp both by one clock, or set [slam] imu_delay_ms = {:.0f}", 1e3 * seconds(a.lag));
  return finding;
}
}  // namespace

std::vector<ImuComparison> compareImus(const std::vector<BodyImu>& imus)
{
  std::vector<ImuComparison> best;
  std::size_t most_votes = 0;
  for (std::size_t reference = 0; reference < imus.size(); ++reference)
  {
    const PlacedGyro of_reference{imus[reference].samples, imus[reference].body_T_imu};
    std::vector<ImuComparison> compared;
    std::size_t votes = 0;
    for (std::size_t i = 0; i < imus.size(); ++i)
    {
      if (i == reference) continue;
      compared.push_back({i, reference, imus[i].body_T_imu.rotation,
                          gyroAgreement(of_reference, {imus[i].samples, imus[i].body_T_imu})});
      const auto& agreement = compared.back().agreement;
      votes += agreement && agrees(*agreement, {}) ? 1 : 0;
    }
    const bool is_majority = 2 * (votes + 1) > imus.size() && votes > 0;
    for (ImuComparison& c : compared) c.outvoted = is_majority && imus.size() > 2;
    if (reference == 0 || votes > most_votes) best = std::move(compared), most_votes = votes;
    if (is_majority || imus.size() == 2) break;
  }
  return best;
}

Finding turnsFinding(const ImuComparison& compared, const std::string& name, const std::string& reference,
                     const TurnLimits& limits)
{
  Finding finding{name, "turns", Verdict::NotMeasured, "not enough rotation to compare"};
  if (!compared.agreement) return finding;
  const GyroAgreement& a = *compared.agreement;
  finding.verdict = Verdict::Ok;
  finding.says = fmt::format("turn rates {:.1f} deg (+-{:.1f}) off those of {}, {:+.1f} ms late, {:.3f} times as large",
                             a.rotation.norm() / kDegree, a.sigma / kDegree, reference, 1e3 * seconds(a.lag), a.scale);
  return agrees(a, limits) ? finding : withFault(std::move(finding), compared, reference, limits);
}
}  // namespace scanloom
