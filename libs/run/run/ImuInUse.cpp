#include "run/run/ImuInUse.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "run/run/internal/TurnCorrelation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/**
 * How much an IMU shakes: the product of both sensors' noise densities ((rad/s)(m/s2)/Hz), by the differences of
 * successive readings, in which the machine's motion hardly shows. None within the first second.
 */
std::optional<double> shaking(const std::deque<ImuSample>& readings)
{
  if (readings.empty() || readings.back().stamp - readings.front().stamp < 1s) return std::nullopt;
  double gyro = 0, accel = 0;
  for (std::size_t i = 1; i < readings.size(); ++i)
  {
    gyro += (readings[i].gyro - readings[i - 1].gyro).squaredNorm();
    accel += (readings[i].accel - readings[i - 1].accel).squaredNorm();
  }
  const double steps = static_cast<double>(readings.size() - 1);
  return std::sqrt(gyro * accel) * seconds(readings.back().stamp - readings.front().stamp) / (6 * steps * steps);
}
}  // namespace

ImuInUse::ImuInUse(const SensorInput& input, const std::string& wanted, Duration delay)
  : input_(input), may_change_(wanted == "auto"), delay_(delay)
{
  std::vector<std::string> names;
  for (const auto& [sensor, body_T_imu] : setup().body_T_imu)  // the body's first, then by sensor id
  {
    sensors_.push_back(sensor);
    names.push_back(nameOf(sensor));
  }
  const auto found = may_change_ ? names.begin() : std::find(names.begin(), names.end(), wanted);
  if (found == names.end())
    throw ConfigError(fmt::format("[slam] imu = {}: the input has no such IMU: {}", wanted, suggestion(wanted, names)));
  sensor_ = previous_ = first_ = sensors_[static_cast<std::size_t>(found - names.begin())];
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
  if (!may_change_ || sensors_.size() == 1) return imu_wait;
  return std::max(imu_wait, kImuSilence + std::max(delay_, Duration{0}));
}

void ImuInUse::change(int sensor) { previous_ = std::exchange(sensor_, sensor); }

bool ImuInUse::changeIfShaken()
{
  constexpr double kMuchMore = 10;  // sound mounts differ by less: doc/study/localisation.md#an-imu-on-a-bad-mount
  if (!may_change_ || compared_ || received_.count(sensor_) == 0) return false;
  std::map<int, double> shakes;
  for (const auto& [sensor, received] : received_)
  {
    const std::optional<double> measured = shaking(received.kept);
    if (!measured) return false;
    shakes[sensor] = *measured;
  }
  compared_ = true;
  const auto [calmest, least] =
      *std::min_element(shakes.begin(), shakes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (kMuchMore * least >= shakes.at(sensor_)) return false;
  const auto found = std::find(sensors_.begin(), sensors_.end(), calmest);
  std::rotate(sensors_.begin(), found, std::next(found));
  change(calmest);
  return true;
}

bool ImuInUse::changeIfSilent(Timestamp now)
{
  if (!may_change_ || !silent(sensor_, now)) return false;
  for (const int sensor : sensors_)
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
  for (const int sensor : sensors_)
  {
    if (sensor == sensor_) return false;
    if (silent(sensor, now) || !receivedWithoutBreak(sensor)) continue;
    const std::vector<ImuSample> better = samplesOf(sensor), in_use = samplesOf(sensor_);
    if (!turnAlike({better, poseOf(sensor)}, {in_use, this->body_T_imu()})) continue;
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
