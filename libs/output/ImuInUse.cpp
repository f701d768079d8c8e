#include "output/ImuInUse.h"

#include "config/ConfigError.h"
#include "config/Names.h"

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
  std::vector<std::string> names;
  const std::vector<int> sensors = candidates();
  for (const int sensor : sensors) names.push_back(nameOf(sensor));
  const auto found = may_change_ ? names.begin() : std::find(names.begin(), names.end(), wanted);
  if (found == names.end())
    throw ConfigError(fmt::format("[slam] imu = {}: the input has no such IMU: {}", wanted, suggestion(wanted, names)));
  sensor_ = previous_ = first_ = sensors[static_cast<std::size_t>(found - names.begin())];
  body_T_imu_ = *input_.body_T_imu(sensor_);
}

std::vector<int> ImuInUse::candidates() const
{
  std::vector<int> sensors{SensorImu::kBody};
  for (std::size_t i = 0; i < input_.header().lidars.size(); ++i) sensors.push_back(static_cast<int>(i));
  sensors.erase(
      std::remove_if(sensors.begin(), sensors.end(), [this](int sensor) { return !input_.body_T_imu(sensor); }),
      sensors.end());
  return sensors;
}

std::string ImuInUse::nameOf(int sensor) const
{
  return sensor == SensorImu::kBody ? "body" : input_.header().lidars.at(static_cast<std::size_t>(sensor)).name;
}

std::optional<ImuSample> ImuInUse::take(const SensorImu& read)
{
  std::deque<ImuSample>& kept = samples_[read.sensor];
  const ImuSample& sample = read.sample;
  const bool usable = sample.gyro.allFinite() && sample.accel.allFinite();
  if (usable && (kept.empty() || sample.stamp > kept.back().stamp)) kept.push_back(sample);
  while (!kept.empty() && kept.back().stamp - kept.front().stamp > kKept) kept.pop_front();
  return read.sensor == sensor_ ? std::optional(inTime(read)) : std::nullopt;
}

ImuSample ImuInUse::inTime(const SensorImu& read) const
{
  ImuSample sample = read.sample;
  if (read.sensor == first_) sample.stamp -= delay_;
  return sample;
}

bool ImuInUse::silent(int sensor, Timestamp now) const
{
  const auto samples = samples_.find(sensor);
  return samples == samples_.end() || samples->second.empty() || samples->second.back().stamp < now - kPatience;
}

bool ImuInUse::reaches(Timestamp t) const
{
  const auto samples = samples_.find(sensor_);
  return samples != samples_.end() && !samples->second.empty() && inTime({sensor_, samples->second.back()}).stamp >= t;
}

bool ImuInUse::changeIfSilent(Timestamp now)
{
  if (!may_change_ || !silent(sensor_, now)) return false;
  for (const int sensor : candidates())
  {
    if (silent(sensor, now)) continue;
    previous_ = std::exchange(sensor_, sensor);
    body_T_imu_ = *input_.body_T_imu(sensor);
    return true;
  }
  return false;
}

std::vector<ImuSample> ImuInUse::samplesOf(int sensor) const
{
  std::vector<ImuSample> samples;
  if (const auto found = samples_.find(sensor); found != samples_.end())
    for (const ImuSample& sample : found->second) samples.push_back(inTime({sensor, sample}));
  return samples;
}
}  // namespace scanloom
