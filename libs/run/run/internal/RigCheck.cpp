#include "run/run/internal/RigCheck.h"

#include "diagnosis/ImuComparison.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kPeriod = 60s, kImuPeriod = 15s;

Rigid poseOf(const std::map<int, RigImu>& imus, std::optional<int> sensor)
{
  return sensor ? imus.at(*sensor).body_T_imu : Rigid::identity();
}
}  // namespace

RigCheck::RigCheck(std::vector<MountedLidar> lidars, std::map<int, RigImu> imus, std::optional<int> in_use,
                   const Warn& warn)
  : lidars_(std::move(lidars)),
    imus_(std::move(imus)),
    in_use_(in_use),
    consistency_(poseOf(imus_, in_use)),
    warn_(warn)
{
}

void RigCheck::add(int sensor, const ImuSample& sample)
{
  if (sensor == in_use_) consistency_.add(sample);
  if (imus_.count(sensor) == 0 || !sample.gyro.allFinite() || !sample.accel.allFinite()) return;
  std::deque<ImuSample>& heard = heard_[sensor];
  if (!heard.empty() && sample.stamp <= heard.back().stamp) return;
  heard.push_back(sample);
  while (heard.front().stamp < sample.stamp - kPeriod) heard.pop_front();
}

void RigCheck::add(const StateEstimate& estimate)
{
  consistency_.add(estimate);
  const bool places_keyframe = estimate.keyframe && estimate.health != Health::Initialising;  // else it still drifts
  if (places_keyframe) lidars_.add(*estimate.keyframe);
  if (!next_check_)
  {
    next_check_ = estimate.stamp + kPeriod;
    next_imu_check_ = estimate.stamp + kImuPeriod;
  }
  if (estimate.stamp >= *next_imu_check_)
  {
    next_imu_check_ = estimate.stamp + kImuPeriod;
    checkImus();
  }
  if (estimate.stamp < *next_check_) return;
  next_check_ = estimate.stamp + kPeriod;
  check();
}

void RigCheck::changeImu(int sensor)
{
  in_use_ = sensor;
  consistency_ = ImuConsistencyCheck(poseOf(imus_, sensor));
}

void RigCheck::check()
{
  checkImus();
  checkUnits();
  if (!imu_in_use_is_wrong_) checkLidars();
  checkImuInUse();
}

void RigCheck::checkImus()
{
  std::vector<std::vector<ImuSample>> samples;
  std::vector<int> sensors;
  for (const auto& [sensor, heard] : heard_)
  {
    samples.emplace_back(heard.begin(), heard.end());
    sensors.push_back(sensor);
  }
  std::vector<BodyImu> imus;
  for (std::size_t i = 0; i < sensors.size(); ++i)
    imus.push_back({imus_.at(sensors[i]).name, samples[i], imus_.at(sensors[i]).body_T_imu});
  for (const ImuComparison& compared : compareImus(imus, {}))
  {
    const bool used = sensors[compared.imu] == in_use_;
    ImuLimits limits;  // other stamps do not matter of an IMU that is not in use
    if (!used || !compared.outvoted) limits.imu_lag_warning_ms = std::numeric_limits<double>::infinity();
    const Finding finding = turnsFinding(compared, imus[compared.imu].name, imus[compared.reference].name, limits);
    if (finding.verdict < Verdict::Warning) continue;
    imu_in_use_is_wrong_ |= used && compared.outvoted;
    blame(finding.about, finding.says + ": " + finding.mend);
  }
}

/** By gravity alone, which turns as the gyroscope should measure. */
void RigCheck::checkUnits()
{
  const std::optional<std::string> complaint = consistency_.complaint(std::nullopt);
  if (!complaint || imu_in_use_is_wrong_) return;
  imu_in_use_is_wrong_ = true;
  blame("the IMU", *complaint);
}

void RigCheck::checkLidars()
{
  findings_ = lidars_.compare();
  for (const Finding& finding : findings_)
    if (finding.verdict >= Verdict::Warning)
      blame(fmt::format("the lidar '{}'", finding.about), finding.says + ": " + finding.mend);
  const Finding crop = lidars_.crop();
  if (crop.verdict == Verdict::Warning && !told_of_crop_) warn_(crop.says + ": " + crop.mend);
  told_of_crop_ |= crop.verdict == Verdict::Warning;
  findings_.push_back(crop);
}

void RigCheck::checkImuInUse()
{
  agreement_ = consistency_.agreement();
  if (warned()) return;
  if (const std::optional<std::string> complaint = consistency_.complaint(agreement_)) blame("the IMU", *complaint);
}

void RigCheck::blame(const std::string& sensor, const std::string& why)
{
  if (blamed_.insert(sensor).second) warn_(sensor + ": " + why);
}
}  // namespace scanloom
