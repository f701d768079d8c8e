#include "run/run/ImuInUse.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "run/run/internal/TurnCorrelation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kKept = 5s;  // longer than any scan waits

/** Where the machine stands there is nothing to recognise it by. */
bool turnAlike(const PlacedGyro& a, const PlacedGyro& b)
{
  constexpr double kAlike = 0.8;
  return turnCorrelation(a, b).value_or(0) > kAlike;
}
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

std::string imuName(const SensorSetup& setup, int sensor)
{
  return sensor == SensorImu::kBody ? "body" : setup.header.lidars.at(static_cast<std::size_t>(sensor)).name;
}

std::vector<ImuSample> ImuInUse::take(const SensorImu& read)
{
  Received& received = received_[read.sensor];
  std::deque<ImuSample>& kept = received.kept;
  std::vector<ImuSample> readings = received.screening.pass(read.sample);
  kept.insert(kept.end(), readings.begin(), readings.end());
  while (!kept.empty() && kept.back().stamp - kept.front().stamp > kKept) kept.pop_front();
  if (read.sensor != sensor_) return {};
  for (ImuSample& reading : readings) reading = withoutDelay(sensor_, reading);
  return readings;
}

ImuSample ImuInUse::withoutDelay(int sensor, ImuSample sample) const
{
  if (sensor == first_) sample.stamp -= delay_;
  return sample;
}

bool ImuInUse::silent(int sensor, Timestamp now) const
{
  const auto received = received_.find(sensor);
  if (received == received_.end() || received->second.kept.empty()) return true;
  const ImuSample& newest = received->second.kept.back();
  return std::max(newest.stamp, withoutDelay(sensor, newest).stamp) < now - kImuSilence;
}

bool ImuInUse::receivedWithoutBreak(int sensor) const
{
  const std::deque<ImuSample>& kept = received_.at(sensor).kept;
  const auto isBreak = [](const ImuSample& a, const ImuSample& b) { return b.stamp - a.stamp > kImuSilence; };
  return kept.back().stamp - kept.front().stamp >= kKept - kImuSilence &&
         std::adjacent_find(kept.begin(), kept.end(), isBreak) == kept.end();
}

Duration ImuInUse::patience(Duration imu_wait) const
{
  if (!may_change_ || setup().body_T_imu.size() == 1) return imu_wait;
  return std::max(imu_wait, kImuSilence + std::max(delay_, Duration{0}));
}

void ImuInUse::change(int sensor) { previous_ = std::exchange(sensor_, sensor); }

bool ImuInUse::changeIfSilent(Timestamp now)
{
  if (!may_change_ || !silent(sensor_, now)) return false;
  for (const auto& [sensor, body_T_imu] : setup().body_T_imu)
  {
    if (silent(sensor, now)) continue;
    change(sensor);
    return true;
  }
  return false;
}

bool ImuInUse::returnToBetter(Timestamp now)
{
  if (!may_change_) return false;
  for (const auto& [sensor, body_T_imu] : setup().body_T_imu)
  {
    if (sensor == sensor_) return false;
    if (silent(sensor, now) || !receivedWithoutBreak(sensor)) continue;
    const std::vector<ImuSample> better = samplesOf(sensor), in_use = samplesOf(sensor_);
    if (!turnAlike({better, body_T_imu}, {in_use, this->body_T_imu()})) continue;
    change(sensor);
    return true;
  }
  return false;
}

std::vector<ImuSample> ImuInUse::samplesOf(int sensor) const
{
  std::vector<ImuSample> samples;
  if (const auto received = received_.find(sensor); received != received_.end())
    for (const ImuSample& sample : received->second.kept) samples.push_back(withoutDelay(sensor, sample));
  return samples;
}

std::map<std::string, RefusedReadings> ImuInUse::refused() const
{
  std::map<std::string, RefusedReadings> refused;
  for (const auto& [sensor, received] : received_)
    if (const RefusedReadings of_sensor = received.screening.refused(); of_sensor.sum() > 0)
      refused[nameOf(sensor)] = of_sensor;
  return refused;
}

std::optional<ImuInUse> chosenImu(const SensorInput& input, const std::string& wanted, Duration delay)
{
  const bool may_be_none = wanted == "none" || (wanted == "auto" && input.setup().body_T_imu.empty());
  if (may_be_none) return std::nullopt;
  return std::optional<ImuInUse>(std::in_place, input, wanted, delay);
}
}  // namespace scanloom
