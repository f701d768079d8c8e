#include "estimation/imu/internal/SpikeRemoval.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// Ranges of the sensors on machines: 16 g (5 g are a hard shock), 2000 deg/s.
constexpr double kAccelRange = 157, kGyroRange = 35;  // m/s2, rad/s, on an axis

// Largest step between two samples of a quiet machine: a shock of 1.5 g is within it even if one sample sees all of it.
constexpr double kAccelReach = 16, kGyroReach = 2;  // m/s2, rad/s
constexpr Duration kLongestSpike = 50ms;
constexpr Duration kSteps = 100ms;

bool isWithinRange(const ImuSample& sample)
{
  return sample.accel.cwiseAbs().maxCoeff() <= kAccelRange && sample.gyro.cwiseAbs().maxCoeff() <= kGyroRange;
}
}  // namespace

/** Vibration adds to the reach what it showed in the last steps. */
bool SpikeRemoval::isFarFromLast(const ImuSample& sample) const
{
  if (!last_ || sample.stamp - last_->stamp > kLongestSpike) return false;
  double gyro = 0, accel = 0;
  for (const Step& step : steps_)
  {
    gyro = std::max(gyro, step.gyro);
    accel = std::max(accel, step.accel);
  }
  return (sample.gyro - last_->gyro).norm() > kGyroReach + gyro ||
         (sample.accel - last_->accel).norm() > kAccelReach + accel;
}

void SpikeRemoval::accept(ImuSample sample, std::vector<ImuSample>& passed)
{
  if (last_) steps_.push_back({sample.stamp, (sample.gyro - last_->gyro).norm(), (sample.accel - last_->accel).norm()});
  while (!steps_.empty() && sample.stamp - steps_.front().stamp > kSteps) steps_.pop_front();
  sample.after_refused = refused_since_last_;
  refused_since_last_ = false;
  last_ = sample;
  passed.push_back(sample);
}

std::vector<ImuSample> SpikeRemoval::pass(const ImuSample& sample)
{
  if (!isWithinRange(sample))
  {
    ++beyond_range_;
    refused_since_last_ = true;
    return {};
  }
  if (isFarFromLast(sample))
  {
    waiting_.push_back(sample);
    return {};
  }
  std::vector<ImuSample> passed;
  if (stayedAway(sample))
  {
    for (const ImuSample& waiting : waiting_) accept(waiting, passed);
  }
  else if (!waiting_.empty())
  {
    spikes_ += waiting_.size();
    refused_since_last_ = true;
  }
  waiting_.clear();
  accept(sample, passed);
  return passed;
}

/** Too long for a spike, without a gap that would hide its end. */
bool SpikeRemoval::stayedAway(const ImuSample& sample) const
{
  return !waiting_.empty() && sample.stamp - last_->stamp > kLongestSpike &&
         sample.stamp - waiting_.back().stamp <= kLongestSpike;
}
}  // namespace scanloom
