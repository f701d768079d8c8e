#include "run/topics/internal/PredictedMotion.h"

#include "estimation/imu/Preintegration.h"

namespace scanloom
{
namespace
{
constexpr Duration kLongest = 1s;  // of a prediction: later it is worth nothing

/** Constant over the step, as the mean of its ends. */
ImuSample atEnd(ImuSample sample, Timestamp stamp)
{
  sample.stamp = stamp;
  return sample;
}
}  // namespace

void PredictedMotion::advance(const ImuSample& from, const ImuSample& to)
{
  const Preintegration step = preintegrate({from, to}, state_->bias, ImuNoise{});
  state_ = predict(*state_, step);
  turn_rate_ = to.gyro - state_->bias.gyro;
}

std::optional<PredictedMotion::Motion> PredictedMotion::add(const ImuSample& sample)
{
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return std::nullopt;
  samples_.push_back(sample);
  while (sample.stamp - samples_.front().stamp > kLongest) samples_.pop_front();
  if (!state_ || sample.stamp <= state_->stamp) return std::nullopt;
  if (sample.stamp - corrected_ > kLongest) return std::nullopt;
  const ImuSample& before = samples_.size() > 1 ? samples_[samples_.size() - 2] : sample;
  advance(atEnd(before, state_->stamp), sample);
  return motion();
}

PredictedMotion::Motion PredictedMotion::correct(const StateEstimate& estimate)
{
  state_ = NavState{estimate.stamp, estimate.map_T_body * body_T_imu_, estimate.velocity, estimate.imu_bias};
  corrected_ = estimate.stamp;
  turn_rate_.setZero();
  ImuSample before;
  bool has_before = false;
  Motion at_estimate = motion();
  for (const ImuSample& sample : samples_)
  {
    if (sample.stamp <= estimate.stamp)
      turn_rate_ = sample.gyro - estimate.imu_bias.gyro;
    else
    {
      if (state_->stamp == estimate.stamp) at_estimate = motion();
      advance(atEnd(has_before ? before : sample, state_->stamp), sample);
    }
    before = sample;
    has_before = true;
  }
  if (state_->stamp == estimate.stamp) at_estimate = motion();
  return at_estimate;
}

PredictedMotion::Motion PredictedMotion::motion() const
{
  const Rigid map_T_body = state_->map_T_imu * body_T_imu_.inverse();
  const Eigen::Vector3d turn_rate = body_T_imu_.rotation * turn_rate_;
  const Eigen::Vector3d of_imu = map_T_body.rotation.conjugate() * state_->velocity;
  return {state_->stamp, map_T_body, of_imu - turn_rate.cross(body_T_imu_.translation), turn_rate};
}
}  // namespace scanloom
