#include "run/ImuInUse.h"

#include "config/Names.h"
#include "core/ConfigError.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kKept = 5s;  // longer than any scan waits
}  // namespace

ImuInUse::ImuInUse(const SensorInput& input, const std::string& wanted, Duration delay)
  : input_(input), may_change_(wanted == "auto"), delay_(delay)
{
  std::vector<int> sensors;  // the body's first, then by sensor id
  std::vector<std::string> names;
  for (const auto& [sensor, body_T_imu] : setup().body_T_imu)
  {
    sensors.push_back(sensor);
    names.push_back(nameOf(sensor));
  }
  const auto found = may_change_ ? names.begin() : std::find(names.begin(), names.end(), wanted);
  if (found == names.end())
    throw ConfigError(fmt::format("[slam] imu = {}: the input has no such IMU: {}", wanted, suggestion(wanted, names)));
  sensor_ = previous_ = first_ = sensors[static_cast<std::size_t>(found - names.begin())];
}

std::string ImuInUse::nameOf(int sensor) const
{
  return sensor == SensorImu::kBody ? "body" : setup().header.lidars.at(static_cast<std::size_t>(sensor)).name;
}

std::optional<ImuSample> ImuInUse::take(const SensorImu& read)
{
  std::deque<ImuSample>& kept = samples_[read.sensor];
  const ImuSample& sample = read.sample;
  const bool usable = sample.gyro.allFinite() && sample.accel.allFinite();
  if (usable && (kept.empty() || sample.stamp > kept.back().stamp)) kept.push_back(sample);
  while (!kept.empty() && kept.back().stamp - kept.front().stamp > kKept) kept.pop_front();
  return read.sensor == sensor_ ? std::optional(withoutDelay(read)) : std::nullopt;
}

ImuSample ImuInUse::withoutDelay(const SensorImu& read) const
{
  ImuSample sample = read.sample;
  if (read.sensor == first_) sample.stamp -= delay_;
  return sample;
}

bool ImuInUse::silent(int sensor, Timestamp now) const
{
  const auto samples = samples_.find(sensor);
  if (samples == samples_.end() || samples->second.empty()) return true;
  const ImuSample& newest = samples->second.back();
  return std::max(newest.stamp, withoutDelay({sensor, newest}).stamp) < now - kSilence;
}

Duration ImuInUse::patience(Duration imu_wait) const
{
  if (!may_change_ || setup().body_T_imu.size() == 1) return imu_wait;
  return std::max(imu_wait, kSilence + std::max(delay_, Duration{0}));
}

bool ImuInUse::changeIfSilent(Timestamp now)
{
  if (!may_change_ || !silent(sensor_, now)) return false;
  for (const auto& [sensor, body_T_imu] : setup().body_T_imu)
  {
    if (silent(sensor, now)) continue;
    previous_ = std::exchange(sensor_, sensor);
    return true;
  }
  return false;
}

std::vector<ImuSample> ImuInUse::samplesOf(int sensor) const
{
  std::vector<ImuSample> samples;
  if (const auto found = samples_.find(sensor); found != samples_.end())
    for (const ImuSample& sample : found->second) samples.push_back(withoutDelay({sensor, sample}));
  return samples;
}
}  // namespace scanloom
