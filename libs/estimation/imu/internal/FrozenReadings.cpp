#include "estimation/imu/internal/FrozenReadings.h"

#include "estimation/imu/ImuBuffer.h"

#include <algorithm>

namespace scanloom
{
std::vector<ImuSample> FrozenReadings::pass(const ImuSample& sample)
{
  if (!gyro_since_ || sample.gyro != gyro_since_->gyro) gyro_since_ = sample;
  if (!accel_since_ || sample.accel != accel_since_->accel) accel_since_ = sample;
  const Timestamp since = std::min(gyro_since_->stamp, accel_since_->stamp);
  waiting_.push_back(sample);

  // Up to `since` each reading was new, or has changed in time after it.
  const auto isReading = [since](const ImuSample& waiting) { return waiting.stamp <= since; };
  const auto readings_end = std::partition_point(waiting_.begin(), waiting_.end(), isReading);
  std::vector<ImuSample> passed(waiting_.begin(), readings_end);
  waiting_.erase(waiting_.begin(), readings_end);
  if (sample.stamp - since >= kImuSilence)
  {
    refused_ += waiting_.size();
    waiting_.clear();
  }
  return passed;
}
}  // namespace scanloom
