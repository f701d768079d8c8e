#include "estimation/slam/ImuConsistencyCheck.h"

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "estimation/imu/GyroScale.h"
#include "estimation/imu/MeanForce.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr Duration kKept = 60s;
constexpr double kSigmas = 4;  // 1 in 16 000 by chance

/** `scale`: true turn rates over the gyroscope's. Accelerations of the drive falsify it by some factor; a unit by 57.
 */
std::optional<std::string> ofUnits(double scale)
{
  const auto isAbout = [scale](double other) { return scale > other / 4 && scale < other * 4; };
  const std::string finding = fmt::format("the body turns {:.2g} times as fast as its gyroscope measures: ", scale);
  if (isAbout(kDegree)) return finding + "the values are in deg/s, multiply them by 0.0174533";
  if (isAbout(1 / kDegree)) return finding + "the values were converted from deg/s twice, multiply them by 57.2958";
  if (scale < 0) return finding + "its axes are left-handed, change its signs";
  return std::nullopt;
}

/** Units by the IMU alone: gravity must turn as the gyroscope measures. */
std::optional<std::string> ofUnits(const std::vector<ImuSample>& samples)
{
  const std::optional<GyroScale> gyro = gyroScale(samples);
  return gyro && gyro->sigma < 0.2 * std::abs(gyro->scale) ? ofUnits(gyro->scale) : std::nullopt;
}

std::optional<std::string> ofAxes(const GyroAgreement& a)
{
  const double angle = a.rotation.norm();
  if (angle < 5 * kDegree || angle < kSigmas * a.sigma) return std::nullopt;
  const Eigen::Vector3d axis = a.rotation / angle;
  return fmt::format(
      "it turns about other axes than the lidars: its pose in the body is wrong by {:.1f} deg (+-{:.1f}) about ({:.2f} "
      "{:.2f} {:.2f})",
      angle / kDegree, a.sigma / kDegree, axis.x(), axis.y(), axis.z());
}

std::optional<std::string> ofClocks(const GyroAgreement& a)
{
  const double lag = seconds(a.lag);
  // Short drives of right rigs show up to 12 ms.
  if (std::abs(lag) < 0.02 || std::abs(lag) < kSigmas * a.lag_sigma) return std::nullopt;
  return fmt::format(
      "its stamps are {:.0f} ms (+-{:.0f}) {} than the lidars': set [slam] imu_delay_ms = {:.0f}, or stamp "
      "both by one clock",
      1e3 * std::abs(lag), std::ceil(1e3 * a.lag_sigma), lag > 0 ? "later" : "earlier", 1e3 * lag);
}
}  // namespace

void ImuConsistencyCheck::add(const ImuSample& sample)
{
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return;
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return;
  samples_.push_back(sample);
  while (samples_.front().stamp < sample.stamp - kKept) samples_.pop_front();
}

void ImuConsistencyCheck::add(const StateEstimate& estimate)
{
  const bool seen =
      estimate.registration && estimate.registration->outcome == Outcome::Converged && !estimate.recovered;
  if (!seen)
  {
    last_.reset();
    return;
  }
  const StampedPose now{estimate.stamp, estimate.registration->target_T_source};
  if (last_)
    turns_.push_back(
        {last_->stamp, now.stamp, logSo3(last_->map_T_body.rotation.conjugate() * now.map_T_body.rotation)});
  last_ = now;
  while (!turns_.empty() && turns_.front().from < now.stamp - kKept) turns_.pop_front();
}

std::optional<GyroAgreement> ImuConsistencyCheck::agreement() const
{
  return gyroAgreement({turns_.begin(), turns_.end()}, {kept(), body_T_imu_});
}

std::optional<std::string> ImuConsistencyCheck::complaint(const std::optional<GyroAgreement>& agreement) const
{
  if (!agreement) return ofUnits(kept());
  if (agreement->mirrored) return "its axes are left-handed, change its signs";
  if (const auto units = ofUnits(1 / agreement->scale)) return units;
  const std::optional<std::string> axes = ofAxes(*agreement);
  if (!axes) return ofClocks(*agreement);
  const std::optional<std::string> units = ofUnits(kept());  // left-handed axes look like a rotation by 180 deg
  return units ? units : axes;
}

void requireGravity(const std::vector<ImuSample>& samples, const Rigid& body_T_imu)
{
  const std::optional<Eigen::Vector3d> force = meanForce(samples);
  if (!force) return;
  const ForceUnit unit = forceUnitOf(force->norm());
  if (unit != ForceUnit::MetresPerSecondSquared && unit != ForceUnit::Unclear)
    throw std::runtime_error(
        fmt::format("the IMU's mean specific force is {:.3g} m/s2: {}", force->norm(), adviceFor(unit)));
  const Eigen::Vector3d up = body_T_imu.rotation * force->normalized();
  if (degreesBetween(up, Eigen::Vector3d::UnitZ()) > 60)
    throw std::runtime_error(
        fmt::format("by the IMU up is along {} of the body: its pose in the body is wrong by {}, or the signs of its "
                    "accelerometer are",
                    nearestAxis(up), turnUpwards(up)));
}
}  // namespace scanloom
