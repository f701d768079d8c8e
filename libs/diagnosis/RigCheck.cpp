#include "diagnosis/RigCheck.h"

#include "base/core/So3.h"
#include "diagnosis/internal/ImuComparison.h"
#include "diagnosis/internal/ImuSoundness.h"
#include "diagnosis/internal/SelfReturns.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kKept = 60s, kPeriod = 15s;
constexpr std::size_t kAllEvery = 4;  // examinations: the lidars take 1 to 2 s on a core
constexpr Duration kUntilTold = 5s;   // longer than an examination takes, so that a live run does not wait for it

/** Registrations of short drives are noisy: right rigs show up to 12 ms and some degrees, and too small a scale. */
constexpr TurnLimits kBesideLidars{0.9, 5};  // a wrong unit; deg

/**
 * Lidars whose squared turns are left to this share by the IMU's, turned and scaled at will, measured something else:
 * in a corridor 0.15 to 0.70, by the errors of registrations. Elsewhere, right or wrong, an IMU leaves 0.02 at most.
 */
constexpr double kTurnsByNoise = 0.1;

/** The IMUs beside each other. Others' stamps do not matter of an IMU that is not in use. */
RigFaults comparisonFaults(const RigMinute& minute)
{
  std::vector<BodyImu> imus;
  std::vector<int> sensors;
  for (const auto& [sensor, samples] : minute.samples)
  {
    sensors.push_back(sensor);
    imus.push_back({minute.imus.at(sensor).name, samples, minute.imus.at(sensor).body_T_imu});
  }
  RigFaults found;
  for (const ImuComparison& compared : compareImus(imus))
  {
    const bool used = sensors[compared.imu] == minute.in_use;
    TurnLimits limits;
    if (!used || !compared.outvoted) limits.lag_ms = std::numeric_limits<double>::infinity();
    const Finding finding = turnsFinding(compared, imus[compared.imu].name, imus[compared.reference].name, limits);
    if (finding.verdict < Verdict::Warning) continue;
    found.imu_in_use_is_wrong |= used && compared.outvoted;
    found.faults.push_back({finding.about, finding});
  }
  return found;
}

Findings soundnessFindings(const RigImu& imu, const std::vector<ImuSample>& samples)
{
  const ImuSoundness sound = soundnessOf(samples, imu.body_T_imu);
  Findings findings{gravityFinding(imu.name, sound), gyroFinding(imu.name, sound)};
  // The frame of a lidar alone, whose pose nobody gave, is the body's however it is tilted.
  if (!imu.configured_pose.rotation.isApprox(Eigen::Quaterniond::Identity()))
    findings.push_back(upFinding(imu.name, sound, imu.configured_pose));
  return findings;
}
}  // namespace

RigFaults imuFaults(const RigMinute& minute)
{
  RigFaults found = comparisonFaults(minute);
  const bool outvoted = found.imu_in_use_is_wrong;
  for (const auto& [sensor, samples] : minute.samples)
  {
    const bool used = sensor == minute.in_use;
    if (used && outvoted) continue;
    for (const Finding& finding : soundnessFindings(minute.imus.at(sensor), samples))
    {
      if (finding.verdict < Verdict::NotFit) continue;
      found.imu_in_use_is_wrong |= used;
      found.faults.push_back({finding.about, finding});
    }
  }
  return found;
}

RigFaults rigFaults(const RigMinute& minute)
{
  RigFaults found = imuFaults(minute);
  if (found.imu_in_use_is_wrong) return found;
  found.lidars = minute.lidars.compare();
  for (const Finding& finding : found.lidars)
    if (finding.verdict >= Verdict::Warning)
      found.faults.push_back({fmt::format("the lidar '{}'", finding.about), finding});
  const bool lidars_agree = found.faults.empty() && !minute.blamed;
  found.lidars.push_back(minute.lidars.crop());
  if (!minute.in_use || minute.samples.count(*minute.in_use) == 0) return found;
  const RigImu& imu = minute.imus.at(*minute.in_use);
  found.imu = gyroAgreement(minute.turns, {minute.samples.at(*minute.in_use), imu.body_T_imu});
  const ImuComparison beside_lidars{0, 0, imu.body_T_imu.rotation, found.imu, true};
  const Finding turns = turnsFinding(beside_lidars, imu.name, "the lidars", kBesideLidars);
  const bool lidars_turn_alike = found.imu && found.imu->unexplained < kTurnsByNoise;
  if (lidars_agree && lidars_turn_alike && turns.verdict >= Verdict::Warning) found.faults.push_back({imu.name, turns});
  return found;
}

RigCheck::RigCheck(std::vector<MountedLidar> lidars, std::map<int, RigImu> imus, std::optional<int> in_use,
                   const Warn& warn)
  : imus_(std::move(imus)), in_use_(in_use), lidars_(std::move(lidars)), warn_(warn)
{
}

void RigCheck::add(int sensor, const ImuSample& sample)
{
  if (imus_.count(sensor) == 0 || !sample.gyro.allFinite() || !sample.accel.allFinite()) return;
  std::deque<ImuSample>& samples = samples_[sensor];
  if (!samples.empty() && sample.stamp <= samples.back().stamp) return;
  samples.push_back(sample);
  while (samples.front().stamp < sample.stamp - kKept) samples.pop_front();
}

void RigCheck::add(const LocalisedScan& scan)
{
  addTurn(scan);
  if (scan.keyframe) lidars_.add(*scan.keyframe);
  if (pending_.valid() && scan.stamp >= told_at_) tellPending();
  if (!next_) next_ = scan.stamp + kPeriod;
  if (scan.stamp < *next_) return;
  next_ = scan.stamp + kPeriod;
  tellPending();
  const bool all = ++examinations_ % kAllEvery == 0 && !imu_in_use_is_wrong_;
  pending_ = std::async(std::launch::async, all ? &rigFaults : &imuFaults, minute());
  told_at_ = scan.stamp + kUntilTold;
}

void RigCheck::finish()
{
  tellPending();
  tell(imu_in_use_is_wrong_ ? imuFaults(minute()) : rigFaults(minute()));
}

void RigCheck::changeImu(int sensor)
{
  in_use_ = sensor;
  turns_.clear();
  last_registered_.reset();
}

void RigCheck::addTurn(const LocalisedScan& scan)
{
  if (!scan.registered)
  {
    last_registered_.reset();
    return;
  }
  if (last_registered_)
    turns_.push_back({last_registered_->stamp, scan.stamp,
                      logSo3(last_registered_->map_T_body.rotation.conjugate() * scan.registered->rotation)});
  last_registered_ = {scan.stamp, *scan.registered};
  while (!turns_.empty() && turns_.front().from < scan.stamp - kKept) turns_.pop_front();
}

RigMinute RigCheck::minute() const
{
  RigMinute minute{imus_, {}, in_use_, {turns_.begin(), turns_.end()}, lidars_, warned()};
  for (const auto& [sensor, samples] : samples_) minute.samples[sensor] = {samples.begin(), samples.end()};
  return minute;
}

void RigCheck::tellPending()
{
  if (pending_.valid()) tell(pending_.get());
}

void RigCheck::tell(const RigFaults& found)
{
  imu_in_use_is_wrong_ |= found.imu_in_use_is_wrong;
  for (const auto& [sensor, finding] : found.faults)
    if (blamed_.insert(sensor).second) warn_(sensor + ": " + finding.says + ": " + finding.mend);
  if (!found.lidars.empty()) lidars_told_ = found.lidars;
  if (found.imu) imu_told_ = found.imu;
  for (const Finding& finding : found.lidars)
    if (finding.measure == "crop" && finding.verdict == Verdict::Warning && !std::exchange(told_of_crop_, true))
      warn_(finding.says + ": " + finding.mend);
}
}  // namespace scanloom
